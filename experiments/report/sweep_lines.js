// A quantity over one key of a sweep: a line a method, or a line a value of another key.
import { Chart, colourOf, figure, frame, numberAxis, shape, textAxis } from "./charts.js";
import { element, lineKey } from "./elements.js";
import * as palette from "./palette.js";
import { together } from "./sweep_cases.js";

const mostLines = 7;

// At most `most` of 0 … count − 1, with both ends.
function spread(count, most) {
  if (count <= most) return Array.from({ length: count }, (_, i) => i);
  return Array.from({ length: most }, (_, i) => Math.round((i * (count - 1)) / (most - 1)));
}

export class Lines {
  constructor(parent, onChoose) {
    this.chart = new Chart(parent);
    this.onChoose = onChoose;
    this.by = "methods"; // or the number of an axis
  }

  /** `fixed`: index or undefined for each axis; that of x, and of the lines, is not looked at. */
  show(cases, what, m, x, fixed) {
    this.arguments = [cases, what, m, x, fixed];
    const axes = cases.axes.map((axis, k) => [axis, k]).filter(([, k]) => k !== x);
    if (this.by !== "methods" && !axes.some(([, k]) => k === this.by)) this.by = "methods";
    const by = this.by;
    const axis = by === "methods" ? null : cases.axes[by];
    const free = fixed.map((k, i) => (i === x || i === by ? undefined : k));
    const list = cases.where(free);
    const shown = axis ? spread(axis.size, mostLines) : cases.methods.map((_, i) => i);
    const lines = shown.map((k) => ({
      name: axis ? axis.texts[k] : cases.methods[k],
      points: cases.axes[x].texts.map((_, value) => together(cases, what, axis ? m : k,
        list.filter((i) => cases.axes[x].at[i] === value && (!axis || axis.at[i] === k)))),
    }));
    const left = cases.axes.filter((_, k) => k !== x && k !== by && fixed[k] === undefined);
    this.chart.show(`${axis ? `${cases.methods[m]}: ` : ""}${what.label}`,
      (width) => this.draw(width, cases, what, x, lines),
      [this.keys(cases, axes, axis, lines)],
      [element("p", { className: "small", text: [
        axis && axis.size > lines.length ? `${lines.length} of ${axis.size} values of ${axis.label}` : "",
        left.length ? `medians, and a band from the least to the most, over ${left.map((one) => one.label).join(", ")}` : "",
        "×: failed; a click on a point chooses its cases",
      ].filter(Boolean).join("; ") + "." })]);
  }

  keys(cases, axes, axis, lines) {
    const select = element("select", {}, new Option("method", "methods"),
      ...axes.map(([one, k]) => new Option(one.label, k)));
    select.value = String(this.by);
    select.setAttribute("aria-label", "what the lines are of");
    select.addEventListener("change", () => {
      this.by = select.value === "methods" ? "methods" : Number(select.value);
      this.show(...this.arguments);
      this.chart.parent.querySelector("select").focus();
    });
    return element("div", { className: "keys" }, element("label", { text: "a line a " }, select),
      ...lines.map(({ name }, i) => lineKey(colourOf(i), name)));
  }

  draw(width, cases, what, x, lines) {
    const axis = cases.axes[x];
    const height = 320;
    const [left, right, top, bottom] = [60, width - 16, 12, height - 46];
    const known = lines.flatMap(({ points }) => points.filter((point) => point.value !== null));
    const low = known.reduce((a, { low: b }) => Math.min(a, b), Infinity);
    const high = known.reduce((a, { high: b }) => Math.max(a, b), -Infinity);
    const pad = 0.06 * (high - low); // 0 where all are the same, which the axis widens
    const y = known.length ? numberAxis(low - pad, high + pad, bottom, top) : numberAxis(0, 1, bottom, top);
    const numeric = axis.isNumeric && new Set(axis.numbers).size === axis.size;
    const xAxis = numeric ? numberAxis(axis.numbers[0], axis.numbers.at(-1), left + 8, right - 8)
      : textAxis(axis.texts, left, right);
    const at = (k) => xAxis.at(numeric ? axis.numbers[k] : k);
    const root = frame(width, height, { x: xAxis, y, left, right, top, bottom, xLabel: axis.label, yLabel: what.label });
    root.setAttribute("aria-label", `${what.label} over ${axis.label}`);
    lines.forEach(({ name, points }, i) => this.drawLine(root, name, points, colourOf(i), at, y, bottom - 5 - 9 * (i % 4)));
    return root;
  }

  drawLine(root, name, points, colour, at, y, floor) {
    let path = "";
    let joined = false;
    const marks = points.length <= 80;
    points.forEach((point, k) => {
      if (point.all === 0) return;
      const words = `${name}, ${this.arguments[0].axes[this.arguments[3]].texts[k]}: ` +
        (point.value === null ? "failed" : figure(point.value)) +
        (point.all > 1 ? `, ${point.solved} of ${point.all} cases solved` : "");
      if (point.value === null) {
        root.append(this.target(shape("path", { d: `M${at(k) - 4} ${floor - 4}l8 8m0 -8l-8 8`, stroke: colour, "stroke-width": 1.6 }), point, words));
        joined = false;
        return;
      }
      path += `${joined ? "L" : "M"}${at(k).toFixed(2)} ${y.at(point.value).toFixed(2)}`;
      joined = true;
      if (point.high > point.low) {
        root.append(shape("path", { d: `M${at(k)} ${y.at(point.low)}V${y.at(point.high)}`, stroke: colour, "stroke-width": 5, "stroke-opacity": 0.18 }));
      }
      if (marks) {
        root.append(this.target(shape("circle", { cx: at(k), cy: y.at(point.value), r: 3.5, fill: colour }), point, words));
      }
    });
    root.append(shape("path", { d: path, fill: "none", stroke: colour, "stroke-width": 2, "pointer-events": "none",
      "stroke-linejoin": "round" }));
  }

  target(mark, point, words) {
    mark.setAttribute("class", "mark");
    const title = shape("title");
    title.textContent = words;
    mark.append(title);
    mark.addEventListener("click", () => this.onChoose(point.list, words));
    return mark;
  }
}
