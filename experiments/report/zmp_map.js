// Both ZMPs on the floor, in what supports the robot, as it goes on: a map of the first walk.
import { convexHull, soleCorners } from "./floor_marks.js";
import { element, lineKey } from "./elements.js";
import { inset } from "./inset.js";
import * as palette from "./palette.js";
import { ticks } from "./saving.js";

const svgSpace = "http://www.w3.org/2000/svg";
const margin = 0.06; // around the soles [m]
const trail = 0.8; // what is drawn boldly before the time of the walk [s]
const mostHigh = 420; // [px]
const letters = 11; // [px]
const frame = { left: 46, below: 34 }; // for numbers and names of the axes [px]

function made(parent, name, attributes, text) {
  const element = document.createElementNS(svgSpace, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  parent.append(element);
  return element;
}

// The points of a ZMP between two rows, where it is known.
function points(walk, name, from, to) {
  const x = walk.column(`${name}_x_m`);
  const y = walk.column(`${name}_y_m`);
  const list = [];
  for (let i = from; i <= to; ++i) {
    if (Number.isFinite(x[i]) && Number.isFinite(y[i])) list.push([x[i], y[i]]);
  }
  return list;
}

export class ZmpMap {
  constructor(parent) {
    this.parent = parent;
    new ResizeObserver(() => this.drawAnew()).observe(parent);
  }

  /** The map of a walk with soles of `sole` [m]; the robot's ZMP where it is known. */
  show(walk, footsteps, sole) {
    this.walk = walk;
    this.footsteps = footsteps;
    this.sole = sole;
    this.parent.replaceChildren();
    this.svg = null;
    this.parent.hidden = !walk.drawn;
    if (this.parent.hidden) return;
    const known = walk.encoded.zmp_robot_x_m !== undefined &&
      points(walk, "zmp_robot", 0, walk.times.length - 1).length > 1;
    const { demanded } = walk.certificate;
    this.lines = [["zmp", palette.zmp, "planned ZMP, of a point mass", demanded.zmp ?? null]];
    if (known) this.lines.push(["zmp_robot", palette.left, "ZMP of the whole robot", demanded.zmp_robot ?? null]);
    this.levels = walk.encoded.tilt_x !== undefined;
    const head = element("p");
    for (const [, colour, label, kept] of this.lines) {
      head.append(lineKey(colour, kept > 0 ? `${label}: kept ${(1000 * kept).toFixed(0)} mm inside (dashed)` : label), " ");
    }
    head.append(` Shaded: the polygon at the time of the walk; bold: ${trail} s before it. ` +
      (this.levels ? "Of soles at two heights it is the hull of their shadows, which they cast along the ground's force " +
        "in the plane halfway between them; there the robot's ZMP is drawn. " : "") +
      (known ? "The robot's ZMP is drawn from differences of rows; its proved margin is in the table of least margins. " : ""));
    this.note = element("span", { className: "value" });
    head.append(this.note);
    this.parent.append(element("h2", { text: known ? "Both ZMPs in the support polygon" : "The ZMP in the support polygon" }), head);
    this.drawAnew();
  }

  // Letters and lines keep their size on a screen of any width.
  drawAnew() {
    const width = Math.round(this.parent.clientWidth - 28);
    if (this.parent.hidden || !this.walk || width < 100 || (this.svg && this.width === width)) return;
    this.svg?.remove();
    this.width = width;
    this.layOut();
    this.drawAxes();
    this.drawSoles();
    this.inner = made(this.svg, "g", {});
    this.polygon = made(this.inner, "polygon",
      { fill: palette.theme.support, stroke: palette.theme.ink, "stroke-width": 1, points: "" });
    this.insets = this.lines.map(([, colour]) => made(this.inner, "polygon",
      { fill: "none", stroke: colour, "stroke-width": 1.2, "stroke-dasharray": "4 3", points: "" }));
    const last = this.walk.times.length - 1;
    for (const [name, colour] of this.lines) {
      made(this.inner, "polyline", { points: this.text(points(this.walk, name, 0, last)), fill: "none",
        stroke: colour, "stroke-width": 1.3, opacity: 0.6 });
    }
    this.bold = this.lines.map(([, colour]) => made(this.inner, "polyline",
      { fill: "none", stroke: colour, "stroke-width": 2.4, points: "" }));
    this.dots = this.lines.map(([, colour]) => made(this.inner, "circle",
      { r: 4.5, fill: colour, stroke: palette.theme.page, "stroke-width": 1, cx: 0, cy: 0 }));
    this.showTime(this.t ?? 0);
  }

  // Where the world is on the screen: `place` of [x, y] in W [m], at one scale both ways.
  layOut() {
    const corners = this.footsteps.flatMap(({ x_m: x, y_m: y, yaw_rad: yaw }) =>
      soleCorners({ x, y, yaw }, this.sole));
    const [xs, ys] = [0, 1].map((k) => corners.map((corner) => corner[k]));
    const [low, high] = [[Math.min(...xs), Math.min(...ys)], [Math.max(...xs), Math.max(...ys)]];
    this.low = low.map((value) => value - margin);
    const size = high.map((value, k) => value + margin - this.low[k]);
    this.pixels = Math.min((this.width - frame.left) / size[0], (mostHigh - frame.below) / size[1]);
    this.high = this.low.map((value, k) => value + size[k]);
    this.height = Math.ceil(this.pixels * size[1]);
    this.place = ([x, y]) => [frame.left + this.pixels * (x - this.low[0]), this.pixels * (this.high[1] - y)];
    this.svg = made(this.parent, "svg", { width: this.width, height: this.height + frame.below, role: "img",
      "font-size": letters, "aria-label": "Map of the ZMP, the soles and the support polygon, from above" });
    this.svg.classList.add("zmp-map");
  }

  text(list) {
    return list.map((p) => this.place(p).map((value) => value.toFixed(1)).join()).join(" ");
  }

  drawAxes() {
    const { lines, numbers } = palette.theme;
    const [left, bottom] = this.place(this.low);
    const [right, top] = this.place(this.high);
    const count = (pixels, apart) => Math.max(2, Math.round(pixels / apart));
    const write = (x, y, text, more = {}) => made(this.svg, "text", { x, y, fill: numbers, ...more }, text);
    for (const x of ticks(this.low[0], this.high[0], count(right - left, 90))) {
      const [at] = this.place([x, 0]);
      made(this.svg, "path", { d: `M${at} ${top}V${bottom}`, stroke: lines });
      write(at, bottom + 14, x, { "text-anchor": "middle" });
    }
    for (const y of ticks(this.low[1], this.high[1], count(bottom - top, 60))) {
      const [, at] = this.place([0, y]);
      made(this.svg, "path", { d: `M${left} ${at}H${right}`, stroke: lines });
      write(left - 6, at + 4, y, { "text-anchor": "end" });
    }
    made(this.svg, "rect", { x: left, y: top, width: right - left, height: bottom - top, fill: "none", stroke: palette.theme.ticks });
    write((left + right) / 2, bottom + 29, "x [m]", { "text-anchor": "middle" });
    write(0, 0, "y [m]", { "text-anchor": "middle", transform: `translate(10 ${(top + bottom) / 2}) rotate(-90)` });
  }

  // Each footprint, with its name at the edge that points outwards.
  drawSoles() {
    for (const { x_m: x, y_m: y, yaw_rad: yaw, foot, footstep } of this.footsteps) {
      const isLeft = foot === "left";
      const colour = palette.theme[isLeft ? "leftInk" : "rightInk"];
      made(this.svg, "polygon", { points: this.text(soleCorners({ x, y, yaw }, this.sole)),
        fill: "none", stroke: colour, "stroke-width": 1, opacity: 0.8 });
      const out = (isLeft ? 1 : -1) * this.sole[1] / 2;
      const [px, py] = this.place([x - out * Math.sin(yaw), y + out * Math.cos(yaw)]);
      made(this.svg, "text", { x: px, y: py + (isLeft ? -4 : letters + 1), "text-anchor": "middle", fill: colour },
        footstep > 0 ? `${footstep} ${foot}` : `${foot}, at the start`);
    }
  }

  // The sole's shadow along the ground's force, in the plane halfway between those that stand.
  shadow(side, sides, at) {
    const sole = this.walk.sole(side, at);
    if (!this.levels) return sole;
    const heights = sides.map((one) => this.walk.sole(one, at).z);
    const above = heights.reduce((sum, z) => sum + z, 0) / heights.length - sole.z;
    const [dx, dy] = ["tilt_x", "tilt_y"].map((name) => above * (this.walk.value(name, at) || 0));
    return { ...sole, x: sole.x + dx, y: sole.y + dy };
  }

  showTime(t) {
    this.t = t;
    if (this.parent.hidden || !this.walk || !this.svg) return;
    const { walk } = this;
    const at = walk.locate(t);
    const support = walk.supportAt(at);
    const sides = support === "both" ? ["left", "right"] : [support];
    const hull = convexHull(sides.flatMap((side) => soleCorners(this.shadow(side, sides, at), this.sole)));
    this.polygon.setAttribute("points", this.text(hull));
    const from = walk.locate(Math.max(0, t - trail)).row;
    const places = this.lines.map(([name, , , kept], i) => {
      this.insets[i].setAttribute("points", kept > 0 ? this.text(inset(hull, kept)) : "");
      const p = [walk.value(`${name}_x_m`, at), walk.value(`${name}_y_m`, at)];
      const known = p.every(Number.isFinite);
      this.dots[i].style.display = known ? "" : "none";
      const [x, y] = known ? this.place(p) : [0, 0];
      this.dots[i].setAttribute("cx", x);
      this.dots[i].setAttribute("cy", y);
      this.bold[i].setAttribute("points",
        this.text([...points(walk, name, from, at.row), ...(known ? [p] : [])]));
      return p;
    });
    if (places.length < 2) return;
    const apart = 1000 * Math.hypot(places[0][0] - places[1][0], places[0][1] - places[1][1]);
    this.note.textContent = Number.isFinite(apart) ? `Apart now: ${apart.toFixed(1)} mm.` : "";
  }
}
