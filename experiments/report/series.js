// Which curves each plot has. A curve: label, colour, value(walk, place) and how to write it.
import { leastMargins } from "./least_margins.js";
import { drawnFamilies } from "./margin_families.js";
import * as palette from "./palette.js";

const mostSlacks = 4;
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

// One joint at a time, before all others in grey.
function jointSpeeds(robot, limits) {
  const scale = limits.joint_speed_scale ?? 1;
  const joints = robot.legs.flatMap(({ joints: leg }, side) =>
    leg.map((joint) => ({ ...joint, side, limit: joint.speed * scale })),
  );
  const ratio = (joint) => (walk, at) =>
    Math.abs(walk.value(`speed_${joint.name}_rad_s`, at)) / joint.limit;
  const most = (joint, walk) => walk.column(`speed_${joint.name}_rad_s`)
    .reduce((high, speed) => (Math.abs(speed) > high ? Math.abs(speed) : high), 0) / joint.limit;
  const angle = (joint) => (walk, at) => {
    const q = walk.value(`q_${joint.name}_rad`, at);
    const speed = walk.value(`speed_${joint.name}_rad_s`, at);
    return Number.isFinite(q) ? `${speed.toFixed(2)} rad/s at ${q.toFixed(2)} rad` : "does not reach";
  };
  return {
    title: "Joint speed / limit [–]",
    level: { value: 1, colour: palette.limit },
    least: [0, 1.05],
    curves: joints.map((joint) => ({
      label: joint.name,
      colour: palette.faded(palette.grey, 0.45),
      value: ratio(joint),
      quiet: true,
    })),
    // `most`: its largest value in a walk.
    picks: joints.map((joint) => ({
      name: joint.name, colour: palette.feet[joint.side], value: ratio(joint), most: (walk) => most(joint, walk),
      note: angle(joint),
      hint: `at most ±${joint.limit.toFixed(2)} rad/s, ${joint.lower.toFixed(2)} … ${joint.upper.toFixed(2)} rad`,
    })),
    onlyFirst: true,
  };
}

// At first the four families with the least slack of the walk; the others wait in their keys.
function margins(families, walk) {
  const { demanded } = walk.certificate;
  const shown = drawnFamilies(families).filter(({ name }) => (demanded[name] ?? null) !== null);
  const least = leastMargins(walk, families).map(({ family }) => family).filter((name) =>
    shown.some((family) => family.name === name)).slice(0, mostSlacks);
  return {
    title: "Slack, (margin − demanded) / scale [–]",
    axis: "slack [–]",
    hint: "0: just what is demanded; " +
      shown.map(({ label, scale, unit }) => `${label}: 1 = ${scale} ${unit}`).join(", "),
    level: { value: 0, colour: palette.limit },
    fixed: [-0.6, 6],
    hidden: shown.filter(({ name }) => !least.includes(name)).map(({ short }) => short),
    curves: shown.map(({ name, column, short, colour, scale }) => ({
      label: short,
      colour,
      value: (walk, at) => (walk.value(column, at) - demanded[name]) / scale,
    })),
    onlyFirst: true,
  };
}

/** All plots for a robot and a walk's demands. */
export function plotList(robot, walk, families) {
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
    jointSpeeds(robot, walk.certificate.limits),
    margins(families, walk),
  ];
}
