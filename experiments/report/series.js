// Which curves each plot has. A curve: label, colour, value(walk, place) and how to write it.
import * as palette from "./palette.js";

const metres = (v) => `${v.toFixed(3)} m`;
const of = (column) => (walk, at) => walk.value(column, at);

function axisPlot(axis) {
  return {
    title: `CoM and ZMP, ${axis} [m]`,
    curves: [
      { label: "CoM", colour: palette.com, value: of(`com_${axis}_m`), text: metres },
      { label: "ZMP", colour: palette.zmp, value: of(`zmp_${axis}_m`), text: metres },
    ],
  };
}

function jointSpeeds(robot, limits) {
  const scale = limits.joint_speed_scale ?? 1;
  const joints = robot.legs.flatMap(({ joints: leg }, side) =>
    leg.map((joint) => ({ ...joint, side, limit: joint.speed * scale })),
  );
  const ratio = (joint) => (walk, at) =>
    Math.abs(walk.value(`speed_${joint.name}_rad_s`, at)) / joint.limit;
  const highest = (walk, at) => {
    const ratios = joints.map((joint) => ratio(joint)(walk, at));
    const i = ratios.indexOf(Math.max(...ratios));
    return i < 0 ? "" : `highest: ${joints[i].name} ${(ratios[i] * joints[i].limit).toFixed(2)} of ` +
      `${joints[i].limit.toFixed(2)} rad/s`;
  };
  return {
    title: "Joint speeds / limits [–]",
    level: { value: 1, colour: palette.limit },
    least: [0, 1.05],
    curves: joints.map((joint) => ({
      label: joint.name,
      colour: palette.faded(palette.feet[joint.side], 0.85),
      value: ratio(joint),
      group: joint.side === 0 ? "left leg" : "right leg",
      quiet: true,
    })),
    keys: [["left leg", palette.left], ["right leg", palette.right]],
    note: highest,
    onlyFirst: true,
  };
}

/** Families of margins: name, column of trajectory.csv, short label, colour. */
export const marginColumns = [
  ["zmp", "zmp_margin_m", "ZMP", palette.zmp],
  ["zmp_robot", "zmp_robot_margin_m", "robot", palette.left],
  ["clearance", "clearance_m", "scene", "ink"],
  ["self_clearance", "self_clearance_m", "self", palette.second],
  ["joint", "joint_margin_rad", "joints", palette.com],
  ["joint_speed", "joint_speed_margin_rad_s", "speeds", palette.sky],
  ["foot_speed", "foot_speed_margin_m_s", "foot", palette.right],
  ["torque", "torque_margin_n_m", "torque", palette.grey],
  ["friction", "friction_margin", "friction", palette.olive],
  ["joint_acceleration", "joint_acceleration_margin_rad_s2", "accelerations", palette.limit],
];

function margins(families, demanded) {
  const unitOf = Object.fromEntries(families.map((family) => [family.name, family]));
  const shown = marginColumns.filter(([name]) => (demanded[name] ?? null) !== null);
  return {
    title: "Slack",
    hint: "(margin − demanded) / scale; " + shown.map(([name, , label]) =>
      `${label}: 1 = ${unitOf[name].scale} ${unitOf[name].unit}`).join(", "),
    level: { value: 0, colour: palette.limit },
    fixed: [-0.6, 6],
    curves: shown.map(([name, column, label, colour]) => ({
      label,
      colour: colour === "ink" ? palette.theme.ink : colour,
      value: (walk, at) =>
        (walk.value(column, at) - (demanded[name] ?? 0)) / unitOf[name].scale,
    })),
    onlyFirst: true,
  };
}

/** All plots for a robot and the demands of a certificate. */
export function plotList(robot, certificate, families) {
  return [
    axisPlot("x"),
    axisPlot("y"),
    {
      title: "Heights of the soles [m]",
      curves: [
        { label: "left", colour: palette.left, value: of("left_foot_z_m"), text: metres },
        { label: "right", colour: palette.right, value: of("right_foot_z_m"), text: metres },
      ],
    },
    jointSpeeds(robot, certificate.limits),
    margins(families, certificate.demanded),
  ];
}
