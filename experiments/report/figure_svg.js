// A plot as a figure for a paper, in the style of `halfstep plot`: 3.5 in wide, letters of 7 pt, axes
// alone, lines that differ in dash as well as in colour and are named where they end.
import { ticks } from "./saving.js";

const width = 252; // [pt]
const height = 112;
const letters = 7;
const between = 7.6; // names at least [pt]
const perLetter = 4.8; // how wide they are, about [pt]
const dashes = ["", "4 1.6", "1.2 1.2", "5 1.4 1.2 1.4"];
const escaped = (text) => String(text).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
// Colours with a hexadecimal opacity: not all readers of SVG know them.
const paint = (colour) => `stroke="${escaped(colour.slice(0, 7))}"` +
  (colour.length === 9 ? ` stroke-opacity="${(Number.parseInt(colour.slice(7), 16) / 255).toFixed(2)}"` : "");

// Lines of a series in the plot's range; gaps where nothing is known.
function path(xs, ys, place) {
  let text = "";
  let joined = false;
  for (let i = 0; i < xs.length; ++i) {
    const known = ys[i] !== null && ys[i] !== undefined;
    if (known) text += `${joined ? "L" : "M"}${place(xs[i], ys[i]).map((v) => v.toFixed(2)).join(" ")}`;
    joined = known;
  }
  return text;
}

// Where names are written: beside the ends of their lines, in their order, none over another.
function apart(names, low, high) {
  const sorted = [...names].sort((a, b) => a.y - b.y);
  let last = -Infinity;
  for (const name of sorted) last = name.y = Math.max(name.y, last + between, low);
  let next = Infinity;
  for (const name of sorted.reverse()) next = name.y = Math.min(name.y, next - between, high);
  return sorted;
}

/**
 * The shown curves of a plot in its range as an SVG on white. `names` has that of each series, "" for
 * one that has none; `xLabel` and `yLabel` are those of the axes.
 */
export function figureSvg(u, names, yLabel, xLabel = "time [s]") {
  const shown = u.series.slice(1).map((series, i) => ({
    series, name: names[i] ?? "", index: i + 1, values: u.data[i + 1],
    colour: typeof series.stroke === "function" ? series.stroke(u, i + 1) : series.stroke,
  })).filter(({ series }) => series.show);
  const longest = Math.max(0, ...shown.map(({ name }) => name.length));
  const [left, right, top, bottom] = [34, width - 7 - perLetter * longest, 4, height - 24];
  const { x, y } = u.scales;
  const place = (vx, vy) => [
    left + ((vx - x.min) / (x.max - x.min)) * (right - left),
    bottom - ((vy - y.min) / (y.max - y.min)) * (bottom - top),
  ];
  const parts = [`<rect x="${left}" y="${top}" width="${right - left}" height="${bottom - top}" fill="none" stroke="#000000" stroke-width="0.5"/>`];
  const write = (at, up, text, more) => parts.push(`<text x="${at.toFixed(2)}" y="${up.toFixed(2)}"${more}>${escaped(text)}</text>`);
  for (const tick of ticks(x.min, x.max, 6)) {
    const [at] = place(tick, y.min);
    parts.push(`<path d="M${at.toFixed(2)} ${bottom}v2.2" stroke="#000000" stroke-width="0.5"/>`);
    write(at, bottom + 9.5, tick, ' text-anchor="middle"');
  }
  for (const tick of ticks(y.min, y.max, 4)) {
    const [, at] = place(x.min, tick);
    parts.push(`<path d="M${left} ${at.toFixed(2)}h-2.2" stroke="#000000" stroke-width="0.5"/>`);
    write(left - 4, at + 2.4, tick, ' text-anchor="end"');
  }
  write((left + right) / 2, height - 4, xLabel, ' text-anchor="middle"');
  const middle = (top + bottom) / 2;
  write(8, middle, yLabel, ` text-anchor="middle" transform="rotate(-90 8 ${middle})"`);
  const named = shown.filter(({ name }) => name);
  const curves = shown.map(({ series, name, values, colour }) => {
    const dash = name ? dashes[named.findIndex((one) => one.name === name) % dashes.length] : (series.dash ?? []).join(" ");
    return `<path d="${path(u.data[0], values, place)}" fill="none" ${paint(colour)} ` +
      `stroke-width="${name ? 1 : 0.5}"${dash ? ` stroke-dasharray="${dash}"` : ""}/>`;
  });
  const ends = named.map(({ name, values, colour }) => {
    const last = values.findLastIndex((value, i) => value !== null && value !== undefined && u.data[0][i] <= x.max);
    const [, at] = last < 0 ? [0, middle] : place(u.data[0][last], values[last]);
    return { name, colour, y: Math.min(bottom, Math.max(top, at)) + 2.4 };
  });
  for (const { name, colour, y: at } of apart(ends, top + 5, bottom)) {
    write(right + 3, at, name, ` fill="${escaped(colour.slice(0, 7))}"`);
  }
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}pt" height="${height}pt" viewBox="0 0 ${width} ${height}" ` +
    `font-family="DejaVu Sans, sans-serif" font-size="${letters}"><rect width="${width}" height="${height}" fill="#ffffff"/>` +
    `<clipPath id="in"><rect x="${left}" y="${top}" width="${right - left}" height="${bottom - top}"/></clipPath>` +
    `<g clip-path="url(#in)">${curves.join("")}</g>${parts.join("")}</svg>`;
}
