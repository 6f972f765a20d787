// How soon each method had found walks how short: durations of the incumbents over run time.
import uPlot from "uplot";
import { element, lineKey } from "./elements.js";
import * as palette from "./palette.js";
import { themedAxis } from "./plots.js";

const least = 1e-3; // run times below this are drawn as this [s]

// Each method's steps on the run times of all: [times, durations of the first, …].
function staircases(walks) {
  const times = new Set([least]);
  for (const walk of walks) {
    for (const [wall] of walk.improvements) times.add(Math.max(wall, least));
    if (walk.summary.wall_s > 0) times.add(Math.max(walk.summary.wall_s, least));
  }
  const sorted = [...times].sort((a, b) => a - b);
  return [sorted, ...walks.map((walk) => sorted.map((time) => {
    if (time > Math.max(walk.summary.wall_s, least)) return null;
    return walk.improvements.filter(([wall]) => Math.max(wall, least) <= time).at(-1)?.[1] ?? null;
  }))];
}

const colourOf = (i) => palette.sequence[i % palette.sequence.length] === "#000000"
  ? palette.theme.ink : palette.sequence[i % palette.sequence.length];

/** Fills the section, or hides it when there is nothing to show. */
export function anytimePlot(parent, walks) {
  const shown = walks.filter((walk) => walk.improvements.length > 0);
  parent.hidden = shown.length === 0;
  parent.replaceChildren();
  if (parent.hidden) return;
  const keys = element("div", { className: "keys" },
    ...shown.map((walk, i) => lineKey(colourOf(i), walk.label)));
  const body = element("div");
  parent.append(element("h2", { text: "Durations found over run time" }), keys, body);
  const axis = { ...themedAxis(), labelSize: 16 };
  const plot = new uPlot({
    width: body.clientWidth,
    height: 220,
    legend: { show: false },
    cursor: { show: false },
    scales: { x: { time: false, distr: 3 } },
    axes: [
      { ...axis, size: 30, label: "run time [s]" },
      { ...axis, size: 44, label: "duration of the walk [s]" },
    ],
    series: [{}, ...shown.map((_, i) => ({
      stroke: colourOf(i),
      width: 2,
      dash: i < palette.sequence.length ? undefined : [6, 3],
      points: { show: false },
      paths: uPlot.paths.stepped({ align: 1 }),
    }))],
  }, staircases(shown), body);
  new ResizeObserver(() => plot.setSize({ width: body.clientWidth, height: 220 })).observe(body);
}
