// A walk whose parameters were moved by hand: evaluated again and sampled here, nothing is proved.
import { legAngles, reachMargin } from "./leg_posture.js";
import { convexHull, soleCorners } from "./floor_marks.js";
import { SuperposedWalk, waistZ } from "./superposed_walk.js";
import { Walk } from "./walk.js";

const period = 0.02; // of the samples [s]
const difference = 1e-4; // over which foot speeds are taken [s]
const sides = ["left", "right"];
const footAt = [5, 9];

/** What is sampled; other families of a certificate are not looked at. */
export const sampled = [
  ["zmp", "zmp_margin_m", "m"], ["reach", "reach_m", "m"], ["joint", "joint_margin_rad", "rad"],
  ["joint_speed", "joint_speed_margin_rad_s", "rad/s"], ["foot_speed", "foot_speed_margin_m_s", "m/s"],
];

// How far a point is inside a convex polygon, counter-clockwise [m].
function inside(hull, [x, y]) {
  return Math.min(...hull.map((a, i) => {
    const b = hull[(i + 1) % hull.length];
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    return (dx * (y - a[1]) - dy * (x - a[0])) / (Math.hypot(dx, dy) || 1);
  }));
}

const poseOf = (state, side) => {
  const k = footAt[side];
  return { x: state[k], y: state[k + 1], z: state[k + 2], yaw: state[k + 3] };
};

// The waist [x, y, yaw] over a CoM.
function waistOf(state, ahead) {
  const yaw = state[4];
  return [state[0] - ahead * Math.cos(yaw), state[1] - ahead * Math.sin(yaw), yaw];
}

// A sole's place and yaw, seen from the waist.
function fromWaist([wx, wy, yaw], height, sole) {
  const [dx, dy] = [sole.x - wx, sole.y - wy];
  const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
  return [[c * dx + s * dy, c * dy - s * dx, sole.z - height], sole.yaw - yaw];
}

/** Rows [{name: value}] of a walk in closed form at `times` [s], as in trajectory.csv. */
export function rowsAt(walk, robot, limits, times) {
  const { com_ahead_m: ahead, waist_height_m: waistHeight, com_height_m: comHeight } = walk.form;
  // The pendulum's height is that of the robot at the start.
  const { crouch_m: crouch = 0, standing_crouch_m: standing = crouch } = walk.form.half_steps[0];
  const comStanding = comHeight + standing;
  const angles = [null, null]; // of the last row
  return times.map((t) => {
    const x = walk.stateAt(t);
    const waist = waistOf(x, ahead);
    const height = waistHeight + x[waistZ];
    const row = {
      t_s: t, half_step: walk.halfStepAt(t) + 1, com_x_m: x[0], com_y_m: x[1], com_z_m: comStanding + x[waistZ],
      zmp_x_m: x[2], zmp_y_m: x[3], waist_x_m: waist[0], waist_y_m: waist[1], waist_z_m: height,
      waist_yaw_rad: waist[2], joint_margin_rad: Infinity, reach_m: Infinity,
      foot_speed_margin_m_s: Infinity, support: walk.supportAt(t),
    };
    const later = walk.stateAt(t + difference);
    const earlier = walk.stateAt(t - difference);
    sides.forEach((name, side) => {
      const sole = poseOf(x, side);
      for (const [key, value] of Object.entries({ x_m: sole.x, y_m: sole.y, z_m: sole.z, yaw_rad: sole.yaw })) {
        row[`${name}_foot_${key}`] = value;
      }
      const leg = robot.legs[side];
      const [p, yaw] = fromWaist(waist, height, sole);
      const reach = reachMargin(leg, p, yaw);
      if (Number.isFinite(reach)) row.reach_m = Math.min(row.reach_m, reach);
      const q = legAngles(leg, p, yaw, angles[side] ?? leg.standing);
      angles[side] = q;
      leg.joints.forEach((joint, k) => {
        row[`q_${joint.name}_rad`] = q ? q[k] : NaN;
        const inner = q ? Math.min(q[k] - joint.lower, joint.upper - q[k]) : NaN;
        row.joint_margin_rad = Math.min(row.joint_margin_rad, inner);
      });
      const k = footAt[side];
      const speed = Math.hypot(...[0, 1, 2].map((i) => (later[k + i] - earlier[k + i]) / (2 * difference)));
      const margin = (limits.foot_speed_m_s ?? Infinity) - speed;
      row.foot_speed_margin_m_s = Math.min(row.foot_speed_margin_m_s, margin);
    });
    const standing = row.support === "both" ? [0, 1] : [row.support === "left" ? 0 : 1];
    const hull = convexHull(standing.flatMap((side) => soleCorners(poseOf(x, side), robot.sole)));
    row.zmp_margin_m = inside(hull, [x[2], x[3]]);
    return row;
  });
}

// Joint speeds, as central differences of rows, and their margins.
function addSpeeds(rows, robot, limits) {
  const scale = limits.joint_speed_scale ?? 1;
  const joints = robot.legs.flatMap((leg) => leg.joints);
  rows.forEach((row, i) => {
    const [before, after] = [rows[Math.max(0, i - 1)], rows[Math.min(rows.length - 1, i + 1)]];
    row.joint_speed_margin_rad_s = Math.min(...joints.map((joint) => {
      const name = `q_${joint.name}_rad`;
      const speed = (after[name] - before[name]) / (after.t_s - before.t_s || 1);
      row[`speed_${joint.name}_rad_s`] = speed;
      return scale * joint.speed - Math.abs(speed);
    }));
  });
}

/** The walk of `parameters` as the page shows walks. `base`: the run's walk that it was made of. */
export function handWalk(base, form, robot, parameters) {
  const { limits, demanded } = base.certificate;
  const walk = new SuperposedWalk(form, parameters);
  const count = Math.ceil(walk.duration / period - 1e-9);
  const times = Array.from({ length: count }, (_, i) => i * period).concat(walk.duration);
  const rows = rowsAt(walk, robot, limits, times);
  addSpeeds(rows, robot, limits);
  const columns = Object.fromEntries(Object.keys(rows[0]).filter((name) => name !== "support")
    .map((name) => [name, Float64Array.from(rows, (row) => row[name])]));
  const looked = sampled.map(([family]) => family);
  const message = "moved by hand: sampled, not certified";
  return new Walk({
    summary: {
      method: 'by hand',
      certified: false,
      duration_s: walk.duration,
      speedup: base.summary.speedup * (base.duration / walk.duration)
    },
    values: columns,
    support: rows.map((row) => row.support[0]).join(''),
    half_steps: walk.pieces.map((piece, i) => ({
                                  half_step: i + 1,
                                  kind: piece.half.kind,
                                  support: piece.half.support,
                                  start_s: piece.start,
                                  duration_s: piece.duration
                                })),
    certificate: {
      verdict: 'sampled',
      message,
      statements: {},
      not_covered: [],
      limits,
      statement: '',
      demanded: Object.fromEntries(Object.entries(demanded).map(
          ([family, value]) => [family, looked.includes(family) ? value : null])),
    },
  });
}
