// Profiles of half-steps in closed form, as the C++ has them. Source: wpg/README.md, "Rest to rest"
// and "Half-step".

/** 10x³ − 15x⁴ + 6x⁵ on [begin, end]: 0 before, 1 after. */
export function smoothstep(sigma, begin = 0, end = 1) {
  if (sigma <= begin) return 0;
  if (sigma >= end) return 1;
  const x = (sigma - begin) / (end - begin);
  const u = Math.min(x, 1 - x);
  const low = u * u * u * (10 + u * (-15 + 6 * u));
  return x < 0.5 ? low : 1 - low;
}

/** The same with a constant speed but for the fraction `ramp` at both ends. */
export function rampedStep(sigma, begin, end, ramp) {
  if (ramp === 0.5 || sigma <= begin || sigma >= end) return smoothstep(sigma, begin, end);
  const x = (sigma - begin) / (end - begin);
  const scale = (16 * ramp) / (15 - 14 * ramp);
  if (x <= ramp) return scale * smoothstep(x / (2 * ramp));
  if (x >= 1 - ramp) return 1 - scale * smoothstep((1 - x) / (2 * ramp));
  return 0.5 + (15 / (15 - 14 * ramp)) * (x - 0.5);
}

// Polynomials in powers of the place in a piece, from −1 or 0 to 1.
const roundBump = [0, 0, 0, -64, 192, -192, 64];
const rise = [0, 0, 0, -10, 15, -6];
const top = [-1];
const fall = [-1, 0, 0, 10, -15, 6];
const roundRise = [0, 0, 0, -8, 12, -6, 1]; // the halves of the round bump
const roundFall = [-1, 0, 3, 0, -3, 0, 1];
const shift = [0.5, 15 / 16, 0, -10 / 16, 0, 3 / 16];

// The power series of c'' = λ²·(c − p) from c(0) and c'(0).
function solved(lambda, p, value, slope) {
  const c = [value, slope];
  for (let k = 0; k < p.length || Math.abs(c[k]) + Math.abs(c[k + 1]) > 1e-22 * (1 + c[0]); ++k) {
    c.push((lambda * lambda * (c[k] - (p[k] ?? 0))) / ((k + 2) * (k + 1)));
  }
  return c;
}

function ends(c, x) {
  let value = 0;
  let slope = 0;
  let power = 1;
  c.forEach((coefficient, k) => {
    value += coefficient * power;
    slope += coefficient * power * x * k;
    power *= x;
  });
  return [value, slope];
}

function at(pieces, sigma) {
  if (sigma <= 0) return 0;
  if (sigma >= 1) return 1;
  if (sigma > 0.5) return 1 - at(pieces, 1 - sigma);
  const piece = pieces.find(({ end }) => sigma < end) ?? pieces.at(-1);
  const x = (sigma - piece.center) / piece.width;
  return piece.series.reduceRight((value, coefficient) => value * x + coefficient, 0);
}

/** CoM and ZMP from 0 to 1, both at rest at both ends. `theta`: ω·T; `bumpRamp`: 1 of a round bump. */
export class RestToRest {
  constructor(theta, shiftFraction, bumpRamp) {
    const first = 0.5 - 0.5 * shiftFraction;
    const delta = 0.5 * shiftFraction;
    const bump = [];
    const extend = (center, width, zmp) => {
      let [value, slope] = [0, 0];
      const before = bump.at(-1);
      if (before) {
        [value, slope] = ends(before.com, 1);
        slope *= width / before.width;
      }
      bump.push({ center, width, zmp, com: solved(theta * width, zmp, value, slope) });
    };
    if (bumpRamp > 0.5 && bumpRamp < 1) {
      const mixed = (a, b) => a.map((value, k) => (2 * bumpRamp - 1) * value + (2 - 2 * bumpRamp) * (b[k] ?? 0));
      extend(0, 0.5 * first, mixed(roundRise, rise));
      extend(0.5 * first, 0.5 * first, mixed(roundFall, fall));
    } else if (bumpRamp !== 1) {
      const ramp = bumpRamp * first;
      extend(0, ramp, rise);
      if (bumpRamp < 0.5) extend(ramp, first - 2 * ramp, top);
      extend(first - ramp, ramp, fall);
    } else {
      extend(0, first, roundBump);
    }
    const last = bump.at(-1);
    const forced = solved(theta * delta, shift, 0.5, 0);
    const free = solved(theta * delta, [0], 0, 1);
    // Value and slope are continuous where bump and shift meet.
    const [f, fSlope] = ends(last.com, 1);
    const [p, pSlope] = ends(forced, -1);
    const [h, hSlope] = ends(free, -1);
    const s = fSlope * (delta / last.width);
    const determinant = f * hSlope - s * h;
    const a = (p * hSlope - pSlope * h) / determinant;
    const gamma = (s * p - f * pSlope) / determinant;
    const end = (piece) => (piece === last ? first : piece.center + piece.width);
    const scaled = (series) => series.map((c) => a * c);
    const middle = { center: 0.5, width: delta, end: 0.5 };
    const length = Math.max(forced.length, free.length);
    const sum = Array.from({ length }, (_, k) => (forced[k] ?? 0) + gamma * (free[k] ?? 0));
    this.comPieces = [...bump.map((piece) => ({ ...piece, end: end(piece), series: scaled(piece.com) })),
                      { ...middle, series: sum }];
    this.zmpPieces = [...bump.map((piece) => ({ ...piece, end: end(piece), series: scaled(piece.zmp) })),
                      { ...middle, series: shift }];
  }

  com(sigma) { return at(this.comPieces, sigma); }
  zmp(sigma) { return at(this.zmpPieces, sigma); }
}
