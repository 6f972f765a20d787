// Axes and frames of charts that are drawn as SVG.
import { element } from "./elements.js";
import * as palette from "./palette.js";
import { fileName, save, ticks } from "./saving.js";

/** An SVG element with attributes and children. */
export function shape(name, attributes = {}, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

export function text(x, y, words, attributes = {}) {
  const made = shape("text", { x, y, fill: palette.theme.numbers, ...attributes });
  made.textContent = words;
  return made;
}

/** A number as it is read: four digits, no 0.30000000000000004. */
export const figure = (value, digits = 4) => String(Number(value.toPrecision(digits)));

/** Colour i of things without an order that is seen on the page's theme. */
export function colourOf(i) {
  const colour = palette.sequence[i % palette.sequence.length];
  return colour === "#000000" ? palette.theme.ink : colour;
}

/** An axis along numbers: at(value) in pixels from `from` to `to`, and its ticks [[value, text]]. */
export function numberAxis(low, high, from, to, log = false) {
  const [a, b] = low === high ? [low - (Math.abs(low) * 0.05 || 1), high + (Math.abs(high) * 0.05 || 1)] : [low, high];
  const warp = log ? Math.log : (value) => value;
  const at = (value) => from + ((warp(value) - warp(a)) / (warp(b) - warp(a))) * (to - from);
  const count = Math.max(2, Math.floor(Math.abs(to - from) / (Math.abs(to - from) > 250 ? 70 : 45)));
  let list = ticks(a, b, count);
  if (log && b / a > 4) {
    list = [];
    for (let power = 10 ** Math.floor(Math.log10(a)); power <= b; power *= 10) {
      for (const step of b / a > 100 ? [1] : [1, 2, 5]) {
        if (step * power >= a * 0.999 && step * power <= b * 1.001) list.push(step * power);
      }
    }
  }
  return { at, ticks: list.map((value) => [value, figure(value)]) };
}

/** An axis along texts: at(index) is the middle of its band, `band` the bands' width. */
export function textAxis(labels, from, to) {
  const band = (to - from) / labels.length;
  return { band: Math.abs(band), at: (i) => from + (i + 0.5) * band, ticks: labels.map((label, i) => [i, label]) };
}

const shortened = (words, most) => (words.length > most ? `${words.slice(0, most - 1)}…` : words);

// A key without the groups that there is no room for: foot_speed of smoothing.limits.foot_speed.
function keyWithin(words, most) {
  const [group] = words.length > most ? /^\w+\./.exec(words) ?? [""] : [""];
  return group ? keyWithin(words.slice(group.length), most) : shortened(words, most);
}

// As many of an axis' ticks as have room.
function fewer(list, at, room) {
  let last = -Infinity;
  const rising = [...list].sort((p, q) => at(p[0]) - at(q[0]));
  return rising.filter(([value, words]) => {
    const need = room(words);
    if (at(value) - need / 2 < last) return false;
    last = at(value) + need / 2;
    return true;
  });
}

/**
 * An SVG of a height [px] that is as wide as its parent, with axes. `make(width)` gives {x, y, left,
 * right, top, bottom, xLabel, yLabel}; bounds in pixels. Returns {root, x, y, …}.
 */
export function frame(width, height, { x, y, left, right, top, bottom, xLabel, yLabel, grid = true }) {
  const root = shape("svg", { class: "chart", viewBox: `0 0 ${width} ${height}`, width, height, role: "img" });
  const most = Math.max(4, Math.floor((left - 24) / 6));
  for (const [value, words] of fewer(x.ticks, x.at, (label) => 6.2 * shortened(label, 18).length + 10)) {
    const at = x.at(value);
    if (grid) root.append(shape("path", { d: `M${at} ${top}V${bottom}`, stroke: palette.theme.lines }));
    root.append(text(at, bottom + 15, shortened(words, 18), { "text-anchor": "middle" }));
  }
  for (const [value, words] of fewer(y.ticks, y.at, () => 14)) {
    const at = y.at(value);
    if (grid) root.append(shape("path", { d: `M${left} ${at}H${right}`, stroke: palette.theme.lines }));
    root.append(text(left - 5, at + 4, shortened(words, most), { "text-anchor": "end" }));
  }
  root.append(text((left + right) / 2, bottom + 31, keyWithin(xLabel, Math.floor((right - left) / 6)), { "text-anchor": "middle" }));
  const middle = (top + bottom) / 2;
  if (yLabel) root.append(text(12, middle, keyWithin(yLabel, Math.floor((bottom - top) / 5.6)), { "text-anchor": "middle", transform: `rotate(-90 12 ${middle})` }));
  return root;
}

/** A heading with the button that saves the chart below as SVG. */
export function chartHead(title, chartOf) {
  const saver = element("button", { text: "SVG", className: "save", title: "save this chart as SVG" });
  saver.addEventListener("click", () => {
    const copy = chartOf().cloneNode(true);
    const { width, height } = chartOf().viewBox.baseVal;
    copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
    copy.setAttribute("font-family", "sans-serif");
    copy.setAttribute("font-size", "11");
    copy.prepend(shape("rect", { width, height, fill: palette.theme.page }));
    save(new Blob([new XMLSerializer().serializeToString(copy)], { type: "image/svg+xml" }), fileName(title, "svg"));
  });
  return element("div", { className: "chart-head" }, element("h2", { text: title }), saver);
}

/** The same, drawn again when its parent becomes wider or narrower; draw(width) gives the chart. */
export class Chart {
  constructor(parent) {
    this.body = element("div");
    this.parent = parent;
    this.width = 0;
    new ResizeObserver(() => {
      if (this.body.clientWidth !== this.width) this.redraw();
    }).observe(this.body);
  }

  /** `more`: elements below the chart. */
  show(title, draw, before = [], more = []) {
    this.draw = draw;
    this.parent.replaceChildren(chartHead(title, () => this.body.firstChild), ...before, this.body, ...more);
    this.redraw();
  }

  redraw() {
    this.width = this.body.clientWidth;
    if (this.draw && this.width > 0) this.body.replaceChildren(this.draw(this.width));
  }
}
