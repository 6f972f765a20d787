// Box plots: one box a method.
import { Chart, colourOf, figure, numberAxis, shape, text, textAxis, frame } from "./charts.js";
import { element } from "./elements.js";
import * as palette from "./palette.js";

/** The value below which a share of the sorted values lies, linear between them. */
export function quantile(sorted, share) {
  const at = share * (sorted.length - 1);
  const low = Math.floor(at);
  const high = Math.min(low + 1, sorted.length - 1);
  return sorted[low] + (at - low) * (sorted[high] - sorted[low]);
}

const row = 46; // [px] of a box and its name

function draw(width, label, groups) {
  const shown = groups.map((group) => [...group.values].sort((a, b) => a - b));
  const all = shown.flat();
  const [left, right, top] = [12, width - 14, 4];
  const bottom = top + row * groups.length;
  const low = all.length ? all.reduce((a, b) => Math.min(a, b)) : 0;
  const high = all.length ? all.reduce((a, b) => Math.max(a, b)) : 1;
  const pad = 0.02 * (high - low);
  const x = numberAxis(low - pad, high + pad, left, right);
  const y = { ...textAxis(groups.map(() => ""), top, bottom), ticks: [] };
  const root = frame(width, bottom + 40, { x, y, left, right, top, bottom, xLabel: label, yLabel: "" });
  root.setAttribute("aria-label", `Box plots: ${label}`);
  groups.forEach((group, i) => {
    const sorted = shown[i];
    const at = y.at(i) + 8;
    const failed = group.all - sorted.length;
    root.append(text(left, at - 14, `${group.label}: ${sorted.length} of ${group.all}` +
      (failed ? ` (${failed} failed)` : ""), { fill: failed ? palette.theme.ink : palette.theme.numbers }));
    if (!sorted.length) return;
    const [least, first, middle, third, most] = [0, 0.25, 0.5, 0.75, 1].map((q) => x.at(quantile(sorted, q)));
    const colour = colourOf(group.colour ?? i);
    root.append(
      shape("path", { d: `M${least} ${at}H${first}M${third} ${at}H${most}M${least} ${at - 5}V${at + 5}M${most} ${at - 5}V${at + 5}`,
                      stroke: colour, "stroke-width": 1.5 }),
      shape("rect", { x: first, y: at - 9, width: Math.max(1, third - first), height: 18, fill: colour, "fill-opacity": 0.35, stroke: colour }),
      shape("path", { d: `M${middle} ${at - 9}V${at + 9}`, stroke: palette.theme.ink, "stroke-width": 2 }));
    const title = shape("title");
    title.textContent = `${group.label}: median ${figure(quantile(sorted, 0.5))}, quartiles ` +
      `${figure(quantile(sorted, 0.25))} and ${figure(quantile(sorted, 0.75))}, from ${figure(sorted[0])} to ${figure(sorted.at(-1))}`;
    root.append(shape("rect", { x: least, y: at - 10, width: Math.max(2, most - least), height: 20, fill: "transparent" }, title));
  });
  return root;
}

export class Boxes {
  constructor(parent) {
    this.chart = new Chart(parent);
  }

  /** groups: [{label, values of what is proved, all: number of cases, colour: index}]; `of`: "cases". */
  show(label, groups, of) {
    this.chart.show(`Box plots by method: ${label}`, (width) => draw(width, label, groups), [], [
      element("p", { className: "small", text: `Box: quartiles and median; whiskers: least and most, over the ${of} ` +
        "that the method solved: by a proved walk of its own. The others are counted beside its name." })]);
  }
}
