// The least margins of a walk: where each is, in time and between which bodies.
import { drawnFamilies } from "./margin_families.js";

// Margins of a family are told in this unit.
const told = { m: ["cm", 100], rad: ["°", 180 / Math.PI], "rad/s": ["rad/s", 1] };

/** A margin of a family as text. */
export function marginText(value, unit) {
  const [name, factor] = told[unit] ?? [unit === "1" ? "" : unit, 1];
  return Number.isFinite(value) ? `${Number((value * factor).toPrecision(3))} ${name}`.trim() : "–";
}

// The instant of a violation that no column shows, as the certificate's message tells it [s].
function instantOfMessage(walk) {
  const found = / at half-step (\d+), tau = ([\d.e-]+) s/.exec(walk.certificate?.message ?? "");
  const half = found && walk.halfSteps[Number(found[1]) - 1];
  return half ? half.start_s + Number(found[2]) : null;
}

/**
 * The least value of each demanded margin that trajectory.csv has, least slack first:
 * {family, label, value, demanded, slack, unit, t, pair}. `pair` is what is nearest there, for
 * clearances.
 */
export function leastMargins(walk, families) {
  const { demanded } = walk.certificate;
  const least = [];
  for (const { name: family, column, label, unit, scale } of drawnFamilies(families)) {
    if ((demanded[family] ?? null) === null || walk.encoded[column] === undefined) continue;
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
    least.push({ family, label, value, demanded: demanded[family], slack, unit, t, pair });
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
