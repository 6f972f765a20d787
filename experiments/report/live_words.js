// What the page says beside the view: figures of the plan, and what is drawn.

import { handOverWords, numHalfSteps } from "./episode_record.js";

const seconds = (value) => `${value.toFixed(2)} s`;

const mostLetters = 110;

/** A text that is not too long, with three dots for what is left out. */
export function shortened(text, most = mostLetters) {
  return text.length > most ? `${text.slice(0, most)} …` : text;
}

/** Rows of the table of the plan. */
export function planRows(table, { t, plan, grant, world, begun }) {
  const rows = [];
  if (plan) {
    rows.push(["walk", `${plan.walk}, ${handOverWords(plan)}`]);
    rows.push(["footsteps", `${plan.footsteps.length - 2}, ends at ${seconds(plan.duration_s)}`]);
    rows.push(["begun", `half-step ${begun} of ${numHalfSteps(plan)}`]);
  }
  if (grant) {
    const limit = grant.valid_until_s === null ? "" : `, as far as they end by ${seconds(grant.valid_until_s)}`;
    rows.push(["granted", `half-steps up to ${grant.through}${limit}`]);
  }
  if (world?.commanded) rows.push(["commanded", world.commanded]);
  if (world) rows.push(["measured", `world ${world.world}, ${(1000 * (t - world.measured_s)).toFixed(0)} ms ago`]);
  const text = rows.map((row) => row.join("\t")).join("\n");
  if (table.dataset.key === text) return;
  table.dataset.key = text;
  table.replaceChildren(...rows.map(([name, value]) => {
    const row = document.createElement("tr");
    row.append(Object.assign(document.createElement("th"), { textContent: name }),
               Object.assign(document.createElement("td"), { textContent: shortened(value), title: value }));
    return row;
  }));
}

/** Rows of the table of hand-overs, the latest first. */
export function handOverRows(table, walks) {
  // A recording does not tell how long was computed, which is not the same twice.
  const computed = (walk) => 1000 * (walk.check_s + walk.plan_s + walk.smooth_s);
  const timed = walks.some((walk) => Number.isFinite(computed(walk)));
  const cells = walks.slice(-10).reverse().map((walk) => [
    seconds(walk.handed_over_s), `${walk.walk}`, walk.walk === 0 ? "" : `${walk.first_changed}`,
    handOverWords(walk), ...(timed ? [`${computed(walk).toFixed(0)} ms`] : []),
  ]);
  const text = cells.map((row) => row.join("\t")).join("\n");
  if (table.dataset.key === text) return;
  table.dataset.key = text;
  const line = (name, row) => {
    const made = document.createElement("tr");
    made.append(...row.map((textContent) => Object.assign(document.createElement(name), { textContent })));
    return made;
  };
  table.replaceChildren(line("th", ["at", "walk", "from half-step", "why", ...(timed ? ["computed"] : [])]), ...cells.map((row) => line("td", row)));
}

/** What the volumes are: of the message `volumes`, null when they are not drawn; `drawn` of them. */
export function volumesNote(note, volumes, cells, drawn) {
  note.hidden = !volumes;
  if (!volumes) return;
  const centimetres = (metres) => Number((100 * metres).toPrecision(2));
  const sizes = [...cells.values()].map(({ cell_m: cell }) => centimetres(cell));
  const range = [...new Set([Math.min(...sizes), Math.max(...sizes)])].join(" to ");
  const missing = volumes.half_steps.filter((half) => half === null).length;
  const text = `Swept volumes of ${drawn} half-step${drawn === 1 ? "" : "s"} still to come` +
    (drawn > 0 ? `, by cells of ${range} cm, the next one stronger` : "") +
    ": all that the robot sweeps in each, from rest to rest, as it was proved before the walk." +
    (missing > 0 ? ` ${missing} of the plan ${missing === 1 ? "has" : "have"} none, as from the start: ` +
      "proved one by one." : "") +
    " Where half-steps overlap the walk leaves them; its grant is the proof.";
  if (note.textContent !== text) note.textContent = text;
}

/** What the view shows, in words. */
export function legend(list, recorded) {
  const motion = recorded ? "the executed motion of the next 3 s" : "the walk to come, 3 s of it";
  const terms = [
    ["Obstacles", "where they were measured last."],
    ["Shell", "where they may be: r + v·(t − t_m) up to the horizon, as long as they keep to r and v; " +
      "drawn a little larger."],
    ["Footsteps", "filled: begun; outlined: granted, so proved; dashed: to come, not proved yet. " +
      "Blue is left, orange is right."],
    ["Replaced plans", "dashed in pink, fading within 4 s."],
    ["Sole traces, body", `samples of ${motion}: not the proven swept volumes.`],
    ["Goal", "the green disc; it counts while nothing else is commanded. No-step areas are red."],
  ];
  list.replaceChildren(...terms.flatMap(([term, text]) => [
    Object.assign(document.createElement("dt"), { textContent: term }),
    Object.assign(document.createElement("dd"), { textContent: text }),
  ]));
}
