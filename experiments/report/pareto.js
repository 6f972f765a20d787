// Seconds against centimetres: the safest walks of a range of durations, from pareto.csv.
import uPlot from "uplot";
import { element, lineKey } from "./elements.js";
import { drawnFamilies } from "./margin_families.js";
import { themedAxis } from "./plots.js";
import { figureSvg } from "./figure_svg.js";
import { fileName, save } from "./saving.js";

const height = 260; // [px]
const cap = 0.2999; // [m] margins beyond are not told apart
const centimetres = (value) => (typeof value === "number" && value < cap ? 100 * value : null);

function plotOf(parent, walk, families) {
  const rows = [...walk.pareto].sort((a, b) => a.duration_s - b.duration_s);
  const shown = drawnFamilies(families).filter(({ unit, key }) =>
    unit === "m" && rows.some((row) => centimetres(row[key]) !== null));
  const keys = shown.map(({ label, colour }) => [label, colour]);
  const body = element("div");
  const saver = element("button", { text: "SVG", className: "save", title: "save this plot as SVG" });
  const title = `Least margins [cm] over duration, ${walk.label}`;
  parent.append(element("div", { className: "keys" }, element("b", { text: title }),
    ...keys.map(([label, colour]) => lineKey(colour, label)), saver), body);
  const axis = { ...themedAxis(), labelSize: 16 };
  const plot = new uPlot({
    width: body.clientWidth,
    height,
    legend: { show: false },
    cursor: { show: false },
    scales: { x: { time: false }, y: { range: (_, low, high) => [Math.min(0, low), 1.08 * Math.max(high, 0.1)] } },
    axes: [
      { ...axis, size: 30, label: "duration of the walk [s]" },
      { ...axis, size: 44, label: "least margin [cm]" },
    ],
    series: [{}, ...shown.map(({ colour }) => ({
      stroke: colour, width: 2, points: { show: true, size: 7 },
    }))],
  }, [rows.map((row) => row.duration_s), ...shown.map(({ key }) => rows.map((row) => centimetres(row[key])))], body);
  saver.addEventListener("click", () => save(
    new Blob([figureSvg(plot, keys.map(([label]) => label), "least margin [cm]", "duration of the walk [s]")], { type: "image/svg+xml" }),
    fileName(title, "svg")));
  new ResizeObserver(() => plot.setSize({ width: body.clientWidth, height })).observe(body);
}

/** A plot for each walk that has such points; the section is hidden when none has. */
export function paretoPlots(parent, walks, families) {
  const shown = walks.filter((walk) => walk.pareto.length > 0);
  parent.hidden = shown.length === 0;
  parent.replaceChildren();
  if (parent.hidden) return;
  parent.append(element("h2", { text: "Seconds against centimetres" }));
  for (const walk of shown) plotOf(parent, walk, families);
  parent.append(element("p", { className: "small", text: "Each point is a walk of its own, certified; " +
    "margins beyond 30 cm are not drawn." }));
}
