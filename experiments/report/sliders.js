// Overlaps, durations and heights of a run's walk, moved by hand.
import { element, table } from "./elements.js";
import { rowsAt, sampled } from "./hand_walk.js";
import { marginText } from "./least_margins.js";
import { marginWords } from "./margin_families.js";
import { save } from "./saving.js";
import { SuperposedWalk, naturalBound, valueOf } from "./superposed_walk.js";

const mostHalfSteps = 80; // of a walk that has sliders
const longest = 2; // times the planned duration, and the planned height

const copyOf = (parameters) => Object.fromEntries(
  Object.entries(parameters).map(([family, values]) => [family, [...values]]));

/** The two tables that `halfstep smooth --given` reads, {name: text}; numbers are exact. */
export function givenTables(form, parameters) {
  const line = (cells) => `${cells.join(",")}\n`;
  const families = form.families.filter(({ values }) => values in parameters);
  const halfSteps = form.half_steps.map((half, i) =>
    line([i + 1, half.kind, half.support, ...families.map((family) => valueOf(family, parameters, i))]));
  const overlaps = parameters.overlaps.map((overlap, i) =>
    line([i + 1, i % 2 === 0 ? "up_down" : "down_up", overlap]));
  return {
    "half_steps.csv": line(["half_step", "kind", "support", ...families.map(({ column }) => column)]) +
      halfSteps.join(""),
    "overlaps.csv": "junction,kind,overlap_s\n" + overlaps.join(""),
  };
}

// One slider with its value; `write(value)` gives the text beside it.
class Slider {
  constructor(label, write, onInput) {
    this.write = write;
    this.input = element("input");
    Object.assign(this.input, { type: "range", step: "any" });
    this.input.setAttribute("aria-label", label);
    this.told = element("output", { className: "value" });
    this.cell = element("span", { className: "slider" }, this.input, this.told);
    this.input.addEventListener("input", () => onInput(Number(this.input.value)));
  }

  set(value, least, most) {
    Object.assign(this.input, { min: least, max: most, value });
    this.told.textContent = this.write(value);
  }
}

export class Sliders {
  /** `onChange(parameters)` is called when one was moved, with null when all are back. */
  constructor(parent, onChange) {
    this.parent = parent;
    this.onChange = onChange;
  }

  /** Those of a walk with `parameters`; hidden where it has none. `form`: closed_form of its case. */
  show(walk, form) {
    const shown = walk?.parameters && form && form.half_steps.length <= mostHalfSteps;
    this.parent.hidden = !shown;
    if (!shown || walk === this.walk) return;
    const open = this.parent.querySelector("details")?.open ?? false;
    Object.assign(this, { walk, form, parameters: copyOf(walk.parameters) });
    const seconds = (value) => `${value.toFixed(3)} s`;
    const moved = (change) => (value) => {
      change(value);
      this.update();
      this.onChange(this.parameters);
    };
    this.durations = form.half_steps.map((_, i) => new Slider(`Duration of half-step ${i + 1} [s]`, seconds,
      moved((value) => { this.parameters.durations[i] = value; })));
    this.overlaps = walk.parameters.overlaps.map((_, i) => new Slider(`Overlap of half-steps ${i + 1} and ${i + 2} [s]`,
      seconds, moved((value) => { this.parameters.overlaps[i] = value; })));
    this.heights = walk.parameters.height_scales.map((_, i) => new Slider(`Height of step ${i + 1}, over the planned`,
      (value) => `${(100 * value * form.half_steps[2 * i].via_height_m).toFixed(1)} cm`,
      moved((value) => { this.parameters.height_scales[i] = value; })));
    this.least = element("div");
    const button = (text, action) => {
      const made = element("button", { text });
      made.type = "button";
      made.addEventListener("click", action);
      return made;
    };
    const rows = form.half_steps.map((half, i) => [
      `${i + 1}, ${half.kind}, on the ${half.support} foot`, this.durations[i].cell,
      i % 2 === 0 ? this.heights[i / 2].cell : "", this.overlaps[i]?.cell ?? ""]);
    const details = element("details", {},
      element("summary", { text: `By hand: overlaps, durations and heights of ${walk.label}` }),
      element("p", { text: "Move a slider, and A is the walk by hand, B the one of the run. Its closed form is evaluated " +
        "in this page every 0.02 s. Its margins are sampled, not certified: " +
        `${sampled.map(([family]) => marginWords(family)).join(", ")}. Other families of margins are not looked at. ` +
        "Save both tables, and a proof of all of it is tried by: halfstep smooth RUN --given overlaps.csv --given half_steps.csv" }),
      element("p", { className: "buttons" },
        button("save overlaps.csv and half_steps.csv", () => this.save()),
        button("back to the run's", () => this.reset())),
      this.least,
      table(["half-step", "duration", "via height", "overlap with the next"], rows));
    details.open = open;
    this.parent.replaceChildren(details);
    this.update();
  }

  // Every slider to its parameter; overlaps within what the durations allow.
  update() {
    const { durations, overlaps, height_scales: heights } = this.parameters;
    const planned = this.form.half_steps;
    durations.forEach((value, i) => this.durations[i].set(value, Math.min(value, 0.3),
      Math.max(value, longest * planned[i].duration_s)));
    overlaps.forEach((value, i) => {
      const most = naturalBound(planned, this.parameters, i);
      if (value > most) overlaps[i] = most;
      this.overlaps[i].set(overlaps[i], Math.min(0, overlaps[i]), most);
    });
    heights.forEach((value, i) => this.heights[i].set(value, 0, Math.max(value, longest)));
  }

  reset() {
    this.parameters = copyOf(this.walk.parameters);
    this.update();
    this.least.replaceChildren();
    this.onChange(null);
  }

  /** Rows of the walk as the sliders have it, at `times` [s] in their order. */
  rowsAt(times, robot) {
    return rowsAt(new SuperposedWalk(this.form, this.parameters), robot, this.walk.certificate.limits, times);
  }

  save() {
    for (const [name, text] of Object.entries(givenTables(this.form, this.parameters))) {
      save(new Blob([text], { type: "text/csv" }), name);
    }
  }

  /** Tells the least sampled margins of the walk by hand. */
  tell(hand) {
    const { demanded } = hand.certificate;
    const misses = hand.column("joint_margin_rad").findIndex((value) => Number.isNaN(value));
    const rows = sampled.filter(([family]) => demanded[family] !== null).map(([family, column, unit]) => {
      const values = hand.column(column);
      let row = -1;
      values.forEach((value, i) => { if (Number.isFinite(value) && (row < 0 || value < values[row])) row = i; });
      const least = row < 0 ? NaN : values[row];
      const missed = least < demanded[family];
      return [marginWords(family), element("span", { text: marginText(least, unit), className: missed ? "no" : "" }),
              marginText(demanded[family], unit), row < 0 ? "" : `${hand.times[row].toFixed(2)} s`,
              missed ? element("span", { className: "no", text: "✗ missed" }) : "kept at the samples"];
    });
    const gone = element("p", { className: "no", text: misses < 0 ? ""
      : `A leg does not reach its foot from ${hand.times[misses].toFixed(2)} s.` });
    this.least.replaceChildren(
      element("p", { text: `By hand: ${hand.duration.toFixed(3)} s, ${this.walk.label}: ${this.walk.duration.toFixed(3)} s. ` +
        "Sampled, not certified." }), gone,
      table(["margin", "least", "demanded", "at", ""], rows));
  }
}
