// A quantity over two keys of a sweep, as colours.
import { Chart, figure, frame, shape, text, textAxis } from "./charts.js";
import { element } from "./elements.js";
import * as palette from "./palette.js";
import { together } from "./sweep_cases.js";

const leastCell = 7; // [px]; smaller ones are put together
// Viridis: rises in lightness, told apart with any colour vision.
const stops = ["#440154", "#414487", "#2a788e", "#22a884", "#7ad151", "#fde725"]
  .map((colour) => [1, 3, 5].map((at) => Number.parseInt(colour.slice(at, at + 2), 16)));

/** Red, green, blue for a share from 0 to 1. */
function colourAt(share) {
  const at = Math.max(0, Math.min(1, share)) * (stops.length - 1);
  const low = Math.min(stops.length - 2, Math.floor(at));
  return stops[low].map((value, k) => Math.round(value + (at - low) * (stops[low + 1][k] - value)));
}
const css = (rgb) => `rgb(${rgb.join()})`;
const isLight = ([r, g, b]) => 0.299 * r + 0.587 * g + 0.114 * b > 140;

// Values of an axis as at most `most` bands: of each value its band, and the bands' texts.
function bandsOf(axis, most) {
  const count = Math.min(axis.size, Math.max(1, most));
  const of = axis.texts.map((_, k) => Math.floor((k * count) / axis.size));
  const texts = Array.from({ length: count }, (_, band) => axis.texts[of.indexOf(band)]);
  return { of, texts, count };
}

export class HeatMap {
  /** onChoose(cells' cases as a list, words) */
  constructor(parent, onChoose) {
    this.chart = new Chart(parent);
    this.onChoose = onChoose;
    this.at = null; // chosen cell [column, row]
  }

  /** `fixed`: index or undefined for each axis; those of x and y are not looked at. */
  show(cases, what, m, x, y, fixed) {
    const title = `${cases.methods[m]}: ${what.label}`;
    const others = fixed.map((k, axis) => (axis === x || axis === y ? undefined : k));
    this.hint = element("p", { className: "hint" });
    this.chart.show(title, (width) => {
      this.prepare(cases, what, m, x, y, cases.where(others), width);
      return this.draw(width);
    }, [], [this.hint, this.legend(cases, fixed, x, y)]);
  }

  legend(cases, fixed, x, y) {
    const free = cases.axes.filter((_, k) => k !== x && k !== y && fixed[k] === undefined);
    const words = ["×: failed, no proved walk of the method's own", "◣: some of the cases failed"];
    if (free.length) words.push(`each cell: the median over ${free.map((axis) => axis.label).join(", ")}`);
    return element("p", { className: "small", text: `${words.join("; ")}. A click, or the arrow keys, choose a cell.` });
  }

  prepare(cases, what, m, x, y, list, width) {
    const longest = Math.max(...cases.axes[y].texts.map((words) => words.length));
    const [left, right, top] = [Math.max(58, Math.min(0.35 * width, 30 + 6.4 * longest)), width - 12, 34];
    const across = bandsOf(cases.axes[x], Math.floor((right - left) / leastCell));
    const height = Math.max(180, Math.min(460, 24 * cases.axes[y].size));
    const up = bandsOf(cases.axes[y], Math.floor(height / leastCell));
    const bottom = top + height;
    const cells = Array.from({ length: across.count * up.count }, () => []);
    for (const i of list) {
      cells[up.of[cases.axes[y].at[i]] * across.count + across.of[cases.axes[x].at[i]]].push(i);
    }
    const merged = cells.map((cell) => together(cases, what, m, cell));
    const values = merged.map((cell) => cell.value).filter((value) => value !== null);
    const [low, high] = [Math.min(...values), Math.max(...values)];
    Object.assign(this, { cases, what, m, x, y, across, up, left, right, top, bottom, merged, low, high,
      put: across.count < cases.axes[x].size || up.count < cases.axes[y].size });
    if (this.at && (this.at[0] >= across.count || this.at[1] >= up.count)) this.at = null;
  }

  draw(width) {
    const { cases, across, up, left, right, top, bottom } = this;
    const [xAxis, yAxis] = [textAxis(across.texts, left, right), textAxis(up.texts, bottom, top)];
    const root = frame(width, bottom + 40, { x: xAxis, y: yAxis, left, right, top, bottom, grid: false,
      xLabel: cases.axes[this.x].label, yLabel: cases.axes[this.y].label });
    root.setAttribute("tabindex", "0");
    root.setAttribute("aria-label", `${this.what.label} over ${cases.axes[this.x].label} and ${cases.axes[this.y].label}`);
    this.drawScale(root);
    const roomy = xAxis.band > 46 && yAxis.band > 15;
    this.merged.forEach((cell, i) => {
      const [column, row] = [i % across.count, Math.floor(i / across.count)];
      const [cx, cy] = [xAxis.at(column), yAxis.at(row)];
      const [w, h] = [xAxis.band, yAxis.band];
      const rgb = cell.value === null ? null
        : colourAt(this.high > this.low ? (cell.value - this.low) / (this.high - this.low) : 0.5);
      const rect = shape("rect", { x: cx - w / 2, y: cy - h / 2, width: Math.max(1, w - (w > 10 ? 1 : 0)),
        height: Math.max(1, h - (h > 10 ? 1 : 0)), fill: rgb ? css(rgb) : palette.theme.lines, class: "cell" });
      rect.dataset.cell = i;
      root.append(rect);
      const size = Math.min(w, h, 22) * 0.28;
      if (cell.all > 0 && cell.solved === 0) {
        root.append(shape("path", { d: `M${cx - size} ${cy - size}l${2 * size} ${2 * size}m0 ${-2 * size}l${-2 * size} ${2 * size}`,
          stroke: palette.zmp, "stroke-width": 1.6, "pointer-events": "none" }));
      } else if (cell.solved < cell.all) {
        root.append(shape("path", { d: `M${cx - w / 2} ${cy + h / 2}v${-1.4 * size}l${1.4 * size} ${1.4 * size}z`,
          fill: palette.zmp, "pointer-events": "none" }));
      }
      if (roomy && rgb) {
        root.append(text(cx, cy + 4, figure(cell.value, 3), { "text-anchor": "middle",
          fill: isLight(rgb) ? "#000000" : "#ffffff", "pointer-events": "none" }));
      }
    });
    this.place = { xAxis, yAxis };
    this.outline = shape("rect", { fill: "none", stroke: palette.theme.ink, "stroke-width": 2.5, "pointer-events": "none" });
    root.append(this.outline);
    this.connect(root);
    this.mark();
    return root;
  }

  // What the colours mean.
  drawScale(root) {
    if (!Number.isFinite(this.low)) return;
    const [from, to] = [this.left, Math.min(this.right, this.left + 260)];
    const gradient = shape("linearGradient", { id: "scale" }, ...stops.map((rgb, k) =>
      shape("stop", { offset: k / (stops.length - 1), "stop-color": css(rgb) })));
    root.append(shape("defs", {}, gradient),
      shape("rect", { x: from, y: 4, width: to - from, height: 10, fill: "url(#scale)" }),
      text(from, 26, figure(this.low)), text(to, 26, figure(this.high), { "text-anchor": "end" }),
      text((from + to) / 2, 26, this.what.label.replace(/^.*(\[.*\])$/, "$1").slice(0, 24), { "text-anchor": "middle" }));
  }

  connect(root) {
    const cellOf = (event) => event.target.dataset?.cell;
    root.addEventListener("pointermove", (event) => {
      if (cellOf(event) !== undefined) this.tell(Number(cellOf(event)));
    });
    root.addEventListener("click", (event) => {
      if (cellOf(event) === undefined) return;
      const i = Number(cellOf(event));
      this.choose([i % this.across.count, Math.floor(i / this.across.count)]);
    });
    root.addEventListener("keydown", (event) => {
      const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!move) return;
      event.preventDefault();
      const [column, row] = this.at ?? [-move[0], -move[1]];
      this.choose([Math.max(0, Math.min(this.across.count - 1, column + move[0])),
                   Math.max(0, Math.min(this.up.count - 1, row + move[1]))]);
    });
  }

  words(i) {
    const cell = this.merged[i];
    const [column, row] = [i % this.across.count, Math.floor(i / this.across.count)];
    const keys = `${this.cases.axes[this.x].label} ${this.across.texts[column]}${this.put ? " …" : ""}, ` +
      `${this.cases.axes[this.y].label} ${this.up.texts[row]}${this.put ? " …" : ""}`;
    if (cell.all === 0) return `${keys}: no case`;
    const value = cell.value === null ? "failed" : figure(cell.value);
    return cell.all === 1 ? `${keys}: ${value}`
      : `${keys}: ${cell.value === null ? value : `median ${value}`}, ${cell.solved} of ${cell.all} cases solved`;
  }

  tell(i) {
    this.hint.textContent = this.words(i);
  }

  choose(at) {
    this.at = at;
    const i = at[1] * this.across.count + at[0];
    this.mark();
    this.tell(i);
    this.onChoose(this.merged[i].list, this.words(i));
  }

  mark() {
    if (!this.at) return this.outline.setAttribute("visibility", "hidden");
    const { xAxis, yAxis } = this.place;
    const [w, h] = [xAxis.band, yAxis.band];
    for (const [key, value] of Object.entries({ x: xAxis.at(this.at[0]) - w / 2, y: yAxis.at(this.at[1]) - h / 2,
      width: w, height: h, visibility: "visible" })) this.outline.setAttribute(key, value);
    return undefined;
  }
}
