// The least margins of a walk: where each is, in time and between which bodies.
import { drawnFamilies, marginWords } from "./margin_families.js";

// Margins of a family are told in this unit.
const told = { m: ["cm", 100], rad: ["°", 180 / Math.PI], "rad/s": ["rad/s", 1] };

/** A margin of a family as text. */
export function marginText(value, unit) {
  const [name, factor] = told[unit] ?? [unit === "1" ? "" : unit, 1];
  return Number.isFinite(value) ? `${Number((value * factor).toPrecision(3))} ${name}`.trim() : "–";
}

/** The same of a proved bound, rounded down: no more is told than is proved. */
export function provedText(value, unit) {
  if (!Number.isFinite(value)) return "–";
  const [name, factor] = told[unit] ?? [unit === "1" ? "" : unit, 1];
  const scaled = value * factor;
  const step = scaled === 0 ? 1 : Math.max(1e-4, 10 ** (Math.floor(Math.log10(Math.abs(scaled))) - 2));
  return `≥ ${Number((Math.floor(scaled / step) * step).toPrecision(3))} ${name}`.trim();
}

// The instant of a violation that no column shows, as the certificate's message tells it [s].
function instantOfMessage(walk) {
  const found = / at half-step (\d+), tau = ([\d.e-]+) s/.exec(walk.certificate?.message ?? "");
  const half = found && walk.halfSteps[Number(found[1]) - 1];
  return half ? half.start_s + Number(found[2]) : null;
}

/**
 * The least value of each demanded margin, least slack first: {family, label, value, proved, demanded,
 * slack, unit, scale, t, pair}. `value` is sampled, of trajectory.csv, and undefined where that has no
 * such column; `proved` holds of all times, and is undefined where nothing is proved. `pair` is what is
 * nearest there, for clearances.
 */
export function leastMargins(walk, families) {
  const { demanded, proved: allProved = {} } = walk.certificate;
  const least = [];
  const unseen = families.filter(({ column }) => column === undefined)
    .map((family) => ({ ...family, label: marginWords(family.name) }));
  for (const { name: family, column, label, unit, scale } of [...drawnFamilies(families), ...unseen]) {
    if ((demanded[family] ?? null) === null) continue;
    const proved = allProved[family]?.least;
    const found = { family, label, proved, demanded: demanded[family], unit, scale };
    if (walk.encoded[column] === undefined) {
      if (proved === undefined) continue;
      const { begin_s: begin, end_s: end } = allProved[family];
      least.push({ ...found, slack: (proved - demanded[family]) / scale, t: (begin + end) / 2 });
      continue;
    }
    const values = walk.column(column);
    let row = -1;
    for (let i = 0; i < values.length; ++i) {
      if (Number.isFinite(values[i]) && (row < 0 || values[i] < values[row])) row = i;
    }
    if (row < 0) continue;
    const pair = walk.nearest.find((near) => near.family === family);
    const value = pair && pair.margin_m <= values[row] ? pair.margin_m : values[row];
    const slack = (value - demanded[family]) / scale;
    const t = pair ? pair.t_s : walk.times[row];
    least.push({ ...found, value, slack, t, pair });
  }
  return least.sort((a, b) => a.slack - b.slack);
}

/** {t, pair} of the worst margin: what the certificate names, where no column misses its demand. */
export function worstInstant(walk, families) {
  const [first] = leastMargins(walk, families);
  const named = walk.certified ? null : instantOfMessage(walk);
  if (named !== null && !(first?.slack < 0)) return { t: named };
  return first ?? null;
}

/**
 * Where a page opens: at the least clearance from obstacles, or else from the robot's own bodies; where
 * the walk meets nothing, at its worst margin. {t, pair}, or null.
 */
export function tellingInstant(walk, families) {
  const least = leastMargins(walk, families);
  const near = ["clearance", "self_clearance"].map((name) => least.find(({ family }) => family === name));
  return near.find((one) => one?.pair) ?? least[0] ?? null;
}
