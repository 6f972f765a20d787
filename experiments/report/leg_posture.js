// Joint angles of a leg under an upright waist that bring its sole to a pose, by Newton's method.

const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
const times = (R, [x, y, z]) => [0, 1, 2].map((i) => R[3 * i] * x + R[3 * i + 1] * y + R[3 * i + 2] * z);
const plus = (a, b) => a.map((x, i) => x + b[i]);
const minus = (a, b) => a.map((x, i) => x - b[i]);

function product(A, B) {
  const C = new Array(9);
  for (let i = 0; i < 3; ++i) {
    for (let j = 0; j < 3; ++j) C[3 * i + j] = A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j];
  }
  return C;
}

function turn([x, y, z], angle) {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const v = 1 - c;
  return [c + v * x * x, v * x * y - s * z, v * x * z + s * y,
          v * x * y + s * z, c + v * y * y, v * y * z - s * x,
          v * x * z - s * y, v * y * z + s * x, c + v * z * z];
}

// Where the sole is in B, and the axes on the way [axis, point].
function placed(leg, q) {
  let R = [1, 0, 0, 0, 1, 0, 0, 0, 1];
  let p = [0, 0, 0];
  const axes = leg.joints.map(({ axis, point }, i) => {
    const here = [times(R, axis), plus(times(R, point), p)];
    const step = turn(axis, q[i]);
    p = plus(p, times(R, minus(point, times(step, point))));
    R = product(R, step);
    return here;
  });
  const m = leg.sole;
  const rotation = product(R, [m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]]);
  return { R: rotation, p: plus(times(R, [m[3], m[7], m[11]]), p), axes };
}

// x of A·x = b by elimination, rows [...A_i, b_i]; null where A is singular.
function solution(rows) {
  for (let k = 0; k < 6; ++k) {
    let best = k;
    for (let i = k + 1; i < 6; ++i) if (Math.abs(rows[i][k]) > Math.abs(rows[best][k])) best = i;
    if (Math.abs(rows[best][k]) < 1e-9) return null;
    [rows[k], rows[best]] = [rows[best], rows[k]];
    for (let i = k + 1; i < 6; ++i) {
      const factor = rows[i][k] / rows[k][k];
      for (let j = k; j < 7; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  const x = new Array(6);
  for (let k = 5; k >= 0; --k) {
    let sum = rows[k][6];
    for (let j = k + 1; j < 6; ++j) sum -= rows[k][j] * x[j];
    x[k] = sum / rows[k][k];
  }
  return x;
}

/**
 * Angles [rad] near `from` for the sole at `p` [m] with the yaw [rad], both seen from the waist;
 * null when it does not get there.
 */
export function legAngles(leg, p, yaw, from) {
  const target = turn([0, 0, 1], yaw);
  let q = [...from];
  for (let i = 0; i < 40; ++i) {
    const now = placed(leg, q);
    const transposed = [0, 3, 6, 1, 4, 7, 2, 5, 8].map((k) => now.R[k]);
    const E = product(target, transposed);
    const error = [0.5 * (E[7] - E[5]), 0.5 * (E[2] - E[6]), 0.5 * (E[3] - E[1]), ...minus(p, now.p)];
    if (Math.max(...error.map(Math.abs)) < 1e-11 && E[0] + E[4] + E[8] > 2) return q;
    const columns = now.axes.map(([axis, point]) => [...axis, ...cross(axis, minus(now.p, point))]);
    const step = solution(error.map((e, row) => [...columns.map((column) => column[row]), e]));
    if (!step) return null;
    const largest = Math.max(...step.map(Math.abs));
    q = q.map((angle, k) => angle + step[k] * Math.min(1, 0.4 / largest));
  }
  return null;
}

/** Stretched length less the distance of hip and ankle [m], with the sole as in legAngles. */
export function reachMargin(leg, p, yaw) {
  if (!leg.reach) return NaN;
  const m = leg.sole;
  const at = minus(leg.reach.ankle, [m[3], m[7], m[11]]);
  const fromSole = [0, 1, 2].map((k) => m[k] * at[0] + m[4 + k] * at[1] + m[8 + k] * at[2]);
  const ankle = plus(p, times(turn([0, 0, 1], yaw), fromSole));
  return leg.reach.length - Math.hypot(...minus(ankle, leg.reach.hip));
}
