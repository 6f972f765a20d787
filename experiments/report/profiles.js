// Performance profiles [DolanMore2002]: the share of cases that a method solves within a factor of
// the best method there.
import { Chart, colourOf, figure, frame, numberAxis, shape } from "./charts.js";
import { element, lineKey } from "./elements.js";

const farthest = 1000; // factors beyond are not drawn

/**
 * The staircase of each method, [[factor, share], …]: `values[m][case]` is the method's work, null
 * where it failed.
 */
export function profileOf(values, cases) {
  const best = Array.from({ length: cases }, (_, i) =>
    values.reduce((least, list) => (list[i] === null ? least : Math.min(least, list[i])), Infinity));
  return values.map((list) => {
    const ratios = list.flatMap((value, i) =>
      (value === null ? [] : [best[i] > 0 ? value / best[i] : value > 0 ? Infinity : 1])).sort((a, b) => a - b);
    const points = [[1, 0]];
    ratios.forEach((ratio, i) => {
      const share = (i + 1) / cases;
      if (points.at(-1)[0] === ratio) points.at(-1)[1] = share;
      else points.push([ratio, share]);
    });
    return points;
  });
}

function draw(width, label, curves) {
  const height = 270;
  const [left, right, top, bottom] = [54, width - 14, 8, height - 42];
  const most = curves.reduce((far, { points }) => points.reduce((a, [ratio]) =>
    (Number.isFinite(ratio) ? Math.max(a, ratio) : a), far), 1);
  const end = Math.min(farthest, most > 1.0001 ? most ** 1.05 : 2);
  const x = numberAxis(1, end, left, right, true);
  const y = numberAxis(0, 1, bottom, top);
  y.ticks = [0, 0.25, 0.5, 0.75, 1].map((share) => [share, `${100 * share}`]);
  const root = frame(width, height, { x, y, left, right, top, bottom,
    xLabel: `factor of the least ${label}`, yLabel: "share of cases [%]" });
  root.setAttribute("aria-label", `Performance profile by ${label}`);
  curves.forEach(({ points, colour, name }) => {
    let path = "";
    let share = 0;
    for (const [ratio, next] of points) {
      if (ratio > end) break;
      path += `${path ? "H" : `M`}${path ? x.at(ratio).toFixed(2) : `${x.at(ratio).toFixed(2)} ${y.at(next).toFixed(2)}`}` +
        (path ? `V${y.at(next).toFixed(2)}` : "");
      share = next;
    }
    path += `H${right}`;
    const title = shape("title");
    title.textContent = `${name}: best in ${figure(100 * points[0][1], 3)} %, solves ${figure(100 * share, 3)} %`;
    root.append(shape("path", { d: path, fill: "none", stroke: colourOf(colour), "stroke-width": 2,
      "stroke-dasharray": colour >= 7 ? "6 3" : "none" }, title));
  });
  return root;
}

export class Profile {
  constructor(parent) {
    this.parent = parent;
    this.chart = new Chart(parent);
    this.chosen = 0;
  }

  /**
   * kinds: [{label, curves: [{name, colour, points}], note}], among which the reader chooses. Draws
   * nothing where there is none.
   */
  show(kinds) {
    this.parent.hidden = kinds.length === 0;
    if (this.parent.hidden) return;
    this.chosen = Math.min(this.chosen, kinds.length - 1);
    const kind = kinds[this.chosen];
    const select = element("select", {}, ...kinds.map(({ label }, i) => new Option(label, i)));
    select.selectedIndex = this.chosen;
    select.setAttribute("aria-label", "what the profile compares");
    select.addEventListener("change", () => {
      this.chosen = select.selectedIndex;
      this.show(kinds);
      this.parent.querySelector("select").focus();
    });
    const keys = element("div", { className: "keys" },
      element("label", { text: "by " }, select),
      ...kind.curves.map(({ name, colour }) => lineKey(colourOf(colour), name)));
    this.chart.show("Performance profile", (width) => draw(width, kind.label, kind.curves), [keys], [
      element("p", { className: "small", text: `${kind.note} Left: how often a method is the best; right: how ` +
        "often it solves a case at all. After Dolan and Moré, 2002." })]);
  }
}
