// Both ZMPs on the floor, in what supports the robot, as it goes on: a map of the first walk.
import { convexHull, soleCorners } from "./floor_marks.js";
import { element, lineKey } from "./elements.js";
import * as palette from "./palette.js";

const svgSpace = "http://www.w3.org/2000/svg";
const margin = 0.06; // around the soles [m]
const trail = 0.8; // what is drawn boldly before the time of the walk [s]

function made(parent, name, attributes) {
  const element = document.createElementNS(svgSpace, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  parent.append(element);
  return element;
}

const text = (points) => points.map(([x, y]) => `${x.toFixed(4)},${(-y).toFixed(4)}`).join(" ");

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
  }

  /** The map of a walk with soles of `sole` [m]; the robot's ZMP where it is known. */
  show(walk, footsteps, sole) {
    this.walk = walk;
    this.sole = sole;
    this.parent.replaceChildren();
    this.parent.hidden = !walk.drawn;
    if (this.parent.hidden) return;
    const known = walk.encoded.zmp_robot_x_m !== undefined &&
      points(walk, "zmp_robot", 0, walk.times.length - 1).length > 1;
    this.lines = [["zmp", palette.zmp, "planned ZMP, of a point mass"]];
    if (known) this.lines.push(["zmp_robot", palette.left, "ZMP of the whole robot"]);
    this.levels = walk.encoded.tilt_x !== undefined;
    const head = element("p");
    for (const [, colour, label] of this.lines) head.append(lineKey(colour, label), " ");
    head.append(` Shaded: the polygon at the time of the walk; bold: ${trail} s before it. ` +
      (this.levels ? "Of soles at two heights it is the hull of their shadows, which they cast along the ground's force " +
        "in the plane halfway between them; there the robot's ZMP is drawn. " : "") +
      (known ? "The robot's ZMP is drawn from differences of rows; its proved margin is in certificate.csv. " : ""));
    this.note = element("span", { className: "value" });
    head.append(this.note);
    this.parent.append(element("h2", { text: known ? "Both ZMPs in the support polygon" : "The ZMP in the support polygon" }), head);

    const corners = footsteps.flatMap(({ x_m: x, y_m: y, yaw_rad: yaw }) =>
      soleCorners({ x, y, yaw }, sole));
    const xs = corners.map(([x]) => x);
    const ys = corners.map(([, y]) => -y);
    const [left, top] = [Math.min(...xs) - margin, Math.min(...ys) - margin];
    const [width, height] = [Math.max(...xs) + margin - left, Math.max(...ys) + margin - top];
    const svg = made(this.parent, "svg", { viewBox: `${left} ${top} ${width} ${height}` });
    svg.classList.add("zmp-map");
    const thin = Math.max(0.0012, width / 900);
    this.scaleBar(svg, left + 0.02, top + height - 0.018, thin);
    for (const { x_m: x, y_m: y, yaw_rad: yaw } of footsteps) {
      made(svg, "polygon", { points: text(soleCorners({ x, y, yaw }, sole)),
        fill: "none", stroke: palette.theme.sole, "stroke-width": thin });
    }
    this.polygon = made(svg, "polygon",
      { fill: palette.theme.support, stroke: palette.theme.ink, "stroke-width": thin, points: "" });
    const last = walk.times.length - 1;
    for (const [name, colour] of this.lines) {
      made(svg, "polyline", { points: text(points(walk, name, 0, last)), fill: "none",
        stroke: colour, "stroke-width": 1.3 * thin, opacity: 0.6 });
    }
    this.bold = this.lines.map(([, colour]) => made(svg, "polyline",
      { fill: "none", stroke: colour, "stroke-width": 2.2 * thin, points: "" }));
    this.dots = this.lines.map(([, colour]) => made(svg, "circle",
      { r: 4 * thin, fill: colour, stroke: palette.theme.page, "stroke-width": thin, cx: 0, cy: 0 }));
  }

  // 10 cm, with its label, from a point of the drawing on.
  scaleBar(svg, x, y, thin) {
    made(svg, "path", { d: `M${x} ${y}h0.1`, stroke: palette.theme.ink, "stroke-width": 2 * thin });
    const label = made(svg, "text", { x: x + 0.11, y: y + 5 * thin, fill: palette.theme.ink,
      "font-size": 14 * thin });
    label.textContent = "0.1 m";
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
    if (this.parent.hidden || !this.walk) return;
    const { walk } = this;
    const at = walk.locate(t);
    const support = walk.supportAt(at);
    const sides = support === "both" ? ["left", "right"] : [support];
    const corners = sides.flatMap((side) => soleCorners(this.shadow(side, sides, at), this.sole));
    this.polygon.setAttribute("points", text(convexHull(corners)));
    const from = walk.locate(Math.max(0, t - trail)).row;
    const places = this.lines.map(([name], i) => {
      const [x, y] = [walk.value(`${name}_x_m`, at), walk.value(`${name}_y_m`, at)];
      const known = Number.isFinite(x) && Number.isFinite(y);
      this.dots[i].style.display = known ? "" : "none";
      this.dots[i].setAttribute("cx", known ? x : 0);
      this.dots[i].setAttribute("cy", known ? -y : 0);
      this.bold[i].setAttribute("points",
        text([...points(walk, name, from, at.row), ...(known ? [[x, y]] : [])]));
      return [x, y];
    });
    if (places.length < 2) return;
    const apart = 1000 * Math.hypot(places[0][0] - places[1][0], places[0][1] - places[1][1]);
    this.note.textContent = Number.isFinite(apart) ? `Apart now: ${apart.toFixed(1)} mm.` : "";
  }
}
