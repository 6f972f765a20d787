// What the page says of A and B: how long A takes, and where they are at an instant.
import { marginText } from "./least_margins.js";

/** The description of a margin, as tables have it, with the digits that mean something. */
export function readable(description) {
  return description
    .replace(/(\S+) (m\/s|rad\/s²|rad\/s|N m|m|rad|s|1) \(demanded (\S+)\)/,
      (_, value, unit, demanded) =>
        `${marginText(Number(value), unit)} (${marginText(Number(demanded), unit)} demanded)`)
    .replace(/tau = (\S+) s/, (_, tau) => `τ = ${Number(tau).toFixed(2)} s`);
}

const byId = (id) => document.getElementById(id);

function stateOf(walk, t) {
  const half = walk.halfStepAt(walk.locate(t));
  const ownDuration = (walk.original ?? walk).duration;
  if (t >= walk.duration) return `at its end, ${ownDuration.toFixed(2)} s`;
  return half ? `half-step ${half.half_step} of ${walk.halfSteps.length}, ${half.kind}` : "";
}

/** Of A, and of B where there is one, at t [s]. */
export function tellInstant(walks, t) {
  walks.forEach((walk, i) => {
    const name = "ab"[i];
    byId(`tag-${name}`).textContent = `${name.toUpperCase()} ${walk.label}: ${stateOf(walk, t)}`;
  });
  const near = walks[0]?.nearest.find((pair) => Math.abs(pair.t_s - t) < 0.011);
  byId("pair").hidden = !near;
  if (near) {
    byId("pair").textContent = `A is nearest: ${near.between.join(" – ")}, ` +
      `${marginText(near.margin_m, "m")} at ${t.toFixed(2)} s`;
  }
}

/** The walk A in the page's head; `why` says why it is not feasible, where the run tells. */
export function tellOutcome(a, why) {
  const { duration_s: duration, speedup } = a.summary;
  byId("outcome").textContent = `A: ${duration.toFixed(3)} s` +
    (a.method === "raw" ? "" : `, ${speedup.toFixed(2)} × as fast as raw`) +
    (a.certified ? ", proved for all t" : `, not proved: ${why ?? readable(a.certificate.message)}`);
  byId("outcome").classList.toggle("no", !a.certified);
}
