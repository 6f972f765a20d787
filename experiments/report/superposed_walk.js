// A walk in closed form at any overlaps, durations, heights and support points, as the C++ has it.
// Source: smoothing/README.md, "The homotopy".
import { RestToRest, rampedStep, smoothstep } from "./rest_to_rest.js";

// Quantities of a walk: com x y, zmp x y, waist yaw, of each foot x y z yaw, and the waist's z above
// where it stands on z = 0.
const footAt = { left: 5, right: 9 };
export const waistZ = 13;

const moved = ([x, y, yaw], [px, py]) => [
  x + Math.cos(yaw) * px - Math.sin(yaw) * py, y + Math.sin(yaw) * px + Math.cos(yaw) * py,
];

// The state at rest in W, on the floor or at the via point. Places are [x, y, yaw], with z where there
// are levels.
function restState(half, onFloor, height) {
  const { support, X_WS: place, X_SF: foot, crouch_m: crouch = 0, standing_crouch_m: standing = crouch } = half;
  const [level, landing] = [place[3] ?? 0, foot[3] ?? 0];
  const swing = support === "left" ? "right" : "left";
  const sign = swing === "left" ? 1 : -1;
  const point = onFloor ? [0.5 * foot[0], 0.5 * foot[1]] : [0, sign * half.support_point_m];
  const sole = onFloor ? foot : [half.via_along_m, sign * half.via_lateral_m, 0];
  const state = new Float64Array(14);
  state.set([...moved(place, point), ...moved(place, point), place[2] + (onFloor ? 0.5 * foot[2] : 0)]);
  state.set([place[0], place[1], level, place[2]], footAt[support]);
  state.set([...moved(place, sole), level + (onFloor ? landing : height), place[2] + sole[2]], footAt[swing]);
  state[waistZ] = level + (onFloor ? Math.min(0, landing) - standing : -crouch);
  return state;
}

// X_AC = X_AB · X_BC of places [x, y, yaw, z], and X_BA.
const composed = (a, b) => [...moved(a, b), a[2] + b[2], (a[3] ?? 0) + (b[3] ?? 0)];
const inverse = ([x, y, yaw, z = 0]) => [
  -Math.cos(yaw) * x - Math.sin(yaw) * y, Math.sin(yaw) * x - Math.cos(yaw) * y, -yaw, -z,
];

// The half-steps on the footsteps that the parameters move.
function placed(halfSteps, { footstep_xs: xs, footstep_ys: ys, footstep_yaws: yaws }) {
  if (!xs) return halfSteps;
  const soles = {}; // where each foot stands, once it has moved
  const all = [];
  for (let i = 0; i < halfSteps.length; i += 2) {
    const { support } = halfSteps[i];
    const swing = support === "left" ? "right" : "left";
    const planned = (half) => composed(half.X_WS, half.X_SF);
    const X_WS = soles[support] ?? halfSteps[i].X_WS;
    const onSupport = (half, X_WF) => ({ ...half, X_WS, X_SF: composed(inverse(X_WS), X_WF) });
    all.push(onSupport(halfSteps[i], soles[swing] ?? planned(halfSteps[i])));
    soles[swing] = composed(planned(halfSteps[i + 1]), [xs[i / 2], ys[i / 2], yaws[i / 2]]);
    all.push(onSupport(halfSteps[i + 1], soles[swing]));
  }
  return all;
}

/** What half-step i has of a family, {values, of} in `families` of a report's closed form. */
export const valueOf = ({ values, of }, parameters, i) =>
  parameters[values][of === "step" ? Math.floor(i / 2) : i];

// The half-step with the numbers that the parameters give it, where they do.
function formed(half, families, parameters, i) {
  const given = families.filter(({ values, column }) => column in half && values in parameters);
  return { ...half, ...Object.fromEntries(given.map((family) => [family.column, valueOf(family, parameters, i)])) };
}

class Piece {
  constructor(half, heightScale, omega) {
    this.half = half;
    this.duration = half.duration_s;
    this.up = half.kind === "up";
    this.t1 = 0.5 - 0.5 * half.zmp_shift;
    this.t2 = 0.5 + 0.5 * half.zmp_shift;
    this.shift = new RestToRest(omega * this.duration, half.zmp_shift, half.zmp_bump_ramp);
    this.foot = this.up ? [this.t2 + half.foot_delay, 1] : [0, this.t1 - half.foot_delay];
    this.lift = this.up ? [this.t2, this.t2 + half.lift_share * (1 - this.t2)]
      : [this.t1 - half.lift_share * this.t1, this.t1];
    this.rise = this.up ? [half.rise_begin, half.rise_end] : [1 - half.rise_end, 1 - half.rise_begin];
    const height = half.via_height_m * heightScale;
    this.from = restState(half, this.up, height);
    const to = restState(half, !this.up, height);
    this.delta = to.map((value, q) => value - this.from[q]);
  }

  addTo(state, tau) {
    const sigma = tau / this.duration;
    const { delta } = this;
    const com = this.shift.com(sigma);
    const zmp = this.shift.zmp(sigma);
    const foot = rampedStep(sigma, ...this.foot, this.half.foot_ramp);
    const height = smoothstep(sigma, ...this.lift);
    const rise = delta[waistZ] === 0 ? 0 : smoothstep(sigma, ...this.rise);
    const profiles = [com, com, zmp, zmp, smoothstep(sigma),
                      foot, foot, height, foot, foot, foot, height, foot, rise];
    profiles.forEach((profile, q) => { state[q] += profile * delta[q]; });
  }
}

/** min(before·T, after·T) [s], beyond which an overlap makes no walk. `junction`: from 0. */
export function naturalBound(halfSteps, { durations, zmp_shifts: shifts }, junction) {
  if (junction % 2 === 1) return Math.min(durations[junction], durations[junction + 1]);
  const shiftOf = (i) => shifts?.[i] ?? halfSteps[i].zmp_shift;
  const t2 = 0.5 + 0.5 * shiftOf(junction);
  const t1 = 0.5 - 0.5 * shiftOf(junction + 1);
  return Math.min((1 - t2) * durations[junction], t1 * durations[junction + 1]);
}

export class SuperposedWalk {
  /** `form`: closed_form of a report; `parameters`: overlaps and `values` of its `families`, those of
   * forms and footsteps where the walk has its own. */
  constructor(form, parameters) {
    const omega = Math.sqrt(form.gravity_m_s2 / form.com_height_m);
    let start = 0;
    this.form = form;
    this.pieces = placed(form.half_steps, parameters).map((half, i) => {
      const piece = new Piece(formed(half, form.families, parameters, i),
        parameters.height_scales[Math.floor(i / 2)], omega);
      piece.start = start;
      start += piece.duration - (parameters.overlaps[i] ?? 0);
      return piece;
    });
    const last = this.pieces.at(-1);
    this.duration = last.start + last.duration;
  }

  /** All 14 quantities at t [s]. */
  stateAt(t) {
    const state = Float64Array.from(this.pieces[0].from);
    for (const piece of this.pieces) {
      if (t <= piece.start) break;
      piece.addTo(state, t - piece.start);
    }
    return state;
  }

  /** Index of the latest half-step that has begun. */
  halfStepAt(t) {
    let i = 0;
    while (i + 1 < this.pieces.length && this.pieces[i + 1].start <= t) ++i;
    return i;
  }

  /** The side that stands alone, or "both". */
  supportAt(t) {
    for (let up = 0; up < this.pieces.length; up += 2) {
      const [rising, sinking] = [this.pieces[up], this.pieces[up + 1]];
      if (t - rising.start < rising.t2 * rising.duration) break;
      if (t - sinking.start <= sinking.t1 * sinking.duration) return rising.half.support;
    }
    return "both";
  }
}
