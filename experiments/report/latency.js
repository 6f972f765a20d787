// From when the world was measured to when a walk that was made for it took over: bars of parts.
import * as palette from "./palette.js";

const most = 12; // bars
const row = 15; // [px]
const left = 98;

export const parts = [
  ["sensing age", "#8a94a1"],
  ["check", palette.left],
  ["plan", palette.right],
  ["smooth", palette.com],
  ["hand-over", palette.second],
];

/** [ms] of each part; with a clock that stands still while it computes, what was charged is one. */
function partsOf(walk, clock) {
  const age = walk.asked_s - walk.measured_s;
  const passed = walk.handed_over_s - walk.asked_s;
  if (clock === "lockstep") return [age, 0, 0, 0, passed].map((s) => 1000 * s);
  const { check_s: check, plan_s: plan, smooth_s: smooth } = walk;
  return [age, check, plan, smooth, Math.max(0, passed - check - plan - smooth)].map((s) => 1000 * s);
}

// Such walks answer no measurement: they improve one that is safe, for as long as the world is as it was.
const improvements = new Set(["smoothed", "shortened"]);

const sum = (values) => values.reduce((a, b) => a + b, 0);

function svg(name, attributes, text) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  return element;
}

// A step of the axis that gives at most five ticks.
function tickOf(highest) {
  const base = 10 ** Math.floor(Math.log10(highest / 5));
  return base * [1, 2, 5, 10].find((k) => highest / (base * k) <= 5);
}

export class Latency {
  constructor(parent, sentence, clock) {
    this.parent = parent;
    this.sentence = sentence;
    this.clock = clock;
    this.names = clock === "lockstep" ? { 0: "sensing age", 4: "charged to thinking" }
      : Object.fromEntries(parts.map(([name], i) => [i, name]));
  }

  /** Walks of which the first was not handed over to a walking robot. */
  show(walks) {
    const taken = walks.filter((walk) => walk.walk > 0 && !improvements.has(walk.kind));
    const key = `${taken.length} ${taken.at(-1)?.walk} ${this.parent.clientWidth}`;
    if (key === this.key) return;
    this.key = key;
    const totals = taken.map((walk) => sum(partsOf(walk, this.clock))).sort((a, b) => a - b);
    this.sentence.textContent = taken.length === 0 ? "No walk has taken over because of a measurement yet."
      : `${taken.length} hand-over${taken.length > 1 ? "s" : ""}: median ${totals[(totals.length - 1) >> 1].toFixed(0)} ms, ` +
        `longest ${totals.at(-1).toFixed(0)} ms; without walks that only improve.` +
        (this.clock === "lockstep" ? " Lockstep: time stood still while it computed." : "");
    this.parent.replaceChildren(...(taken.length ? [this.keys(), this.bars(taken.slice(-most))] : []));
  }

  keys() {
    const keys = document.createElement("div");
    keys.className = "keys";
    for (const [i, name] of Object.entries(this.names)) {
      const swatch = document.createElement("i");
      swatch.className = "swatch";
      swatch.style.background = parts[i][1];
      const key = document.createElement("span");
      key.append(swatch, ` ${name}`);
      keys.append(key);
    }
    return keys;
  }

  bars(walks) {
    const width = Math.max(200, this.parent.clientWidth);
    const values = walks.map((walk) => partsOf(walk, this.clock));
    const highest = Math.max(10, ...values.map(sum));
    const tick = tickOf(highest);
    const end = Math.ceil(highest / tick) * tick;
    const x = (ms) => left + (ms / end) * (width - left - 18);
    const bottom = walks.length * row + 2;
    const picture = svg("svg", {
      width, height: bottom + 16, role: "img",
      "aria-label": "latency of hand-overs by parts [ms]",
    });
    for (let ms = 0; ms <= end + 1e-9; ms += tick) {
      picture.append(svg("line", { x1: x(ms), x2: x(ms), y1: 0, y2: bottom, class: "grid" }),
                     svg("text", { x: x(ms), y: bottom + 12, "text-anchor": "middle" }, `${ms}`));
    }
    values.forEach((of, i) => {
      picture.append(svg("text", { x: left - 6, y: i * row + 11, "text-anchor": "end" },
                         `${walks[i].walk} ${walks[i].kind}`));
      let from = 0;
      of.forEach((ms, k) => {
        const bar = svg("rect", { x: x(from), y: i * row + 2, width: x(from + ms) - x(from),
                                  height: row - 4, fill: parts[k][1] });
        bar.append(svg("title", {}, `${this.names[k] ?? parts[k][0]}: ${ms.toFixed(1)} ms`));
        picture.append(bar);
        from += ms;
      });
    });
    return picture;
  }
}
