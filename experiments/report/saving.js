// Files that the reader saves from the page: plots as PNG and SVG, the view as PNG and WebM.
import * as palette from "./palette.js";

/** Lets the reader save a Blob under a name. */
export function save(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** A text as the name of a file. */
export function fileName(text, ending) {
  return `${text.replace(/\[[^\]]*\]/g, "").trim().replace(/[^\p{L}\p{N}.-]+/gu, "_") || "plot"}.${ending}`;
}

/** A plot as it is drawn, under its title, as a PNG. */
export function plotPng(u, title) {
  const ratio = window.devicePixelRatio;
  const canvas = document.createElement("canvas");
  const head = Math.round(22 * ratio);
  canvas.width = u.ctx.canvas.width;
  canvas.height = u.ctx.canvas.height + head;
  const pen = canvas.getContext("2d");
  pen.fillStyle = palette.theme.page;
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.fillStyle = palette.theme.ink;
  pen.font = `${12 * ratio}px sans-serif`;
  pen.fillText(title, 6 * ratio, 15 * ratio);
  pen.drawImage(u.ctx.canvas, 0, head);
  return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
}

const escaped = (text) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

/** Ticks of an axis within a range, about `count` of them. */
export function ticks(low, high, count) {
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough);
  const list = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) {
    list.push(Number((k * step).toPrecision(12)));
  }
  return list;
}

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

/**
 * A plot's shown curves in its range as SVG, on white, with its title and keys [[label, colour]].
 * `xLabel` is that of the axis across.
 */
export function plotSvg(u, title, keys, xLabel = "time [s]") {
  const [width, height, left, top, right, bottom] = [720, 300, 58, 44, 12, 40];
  const { x, y } = u.scales;
  const place = (vx, vy) => [
    left + ((vx - x.min) / (x.max - x.min)) * (width - left - right),
    height - bottom - ((vy - y.min) / (y.max - y.min)) * (height - top - bottom),
  ];
  const parts = [];
  for (const tick of ticks(x.min, x.max, 8)) {
    const [at] = place(tick, y.min);
    parts.push(`<path d="M${at} ${top}V${height - bottom}" stroke="#dddddd"/>` +
      `<text x="${at}" y="${height - bottom + 15}" text-anchor="middle">${tick}</text>`);
  }
  for (const tick of ticks(y.min, y.max, 5)) {
    const [, at] = place(x.min, tick);
    parts.push(`<path d="M${left} ${at}H${width - right}" stroke="#dddddd"/>` +
      `<text x="${left - 6}" y="${at + 4}" text-anchor="end">${tick}</text>`);
  }
  const curves = u.series.slice(1).map((series, i) => {
    if (!series.show) return "";
    const colour = typeof series.stroke === "function" ? series.stroke(u, i + 1) : series.stroke;
    const dash = series.dash ? ` stroke-dasharray="${series.dash.join(" ")}"` : "";
    return `<path d="${path(u.data[0], u.data[i + 1], place)}" fill="none" ` +
      `stroke="${escaped(colour)}" stroke-width="${series.width ?? 1}"${dash}/>`;
  });
  let at = left;
  const legend = keys.map(([label, colour]) => {
    const text = `<path d="M${at} 32h14" stroke="${escaped(colour)}" stroke-width="3"/>` +
      `<text x="${at + 18}" y="36">${escaped(label)}</text>`;
    at += 34 + 7 * label.length;
    return text;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" ` +
    `viewBox="0 0 ${width} ${height}" font-family="sans-serif" font-size="11">` +
    `<rect width="${width}" height="${height}" fill="#ffffff"/>` +
    `<text x="${left}" y="18" font-size="13" font-weight="bold">${escaped(title)}</text>` +
    `${legend.join("")}${parts.join("")}<clipPath id="in"><rect x="${left}" y="${top}" ` +
    `width="${width - left - right}" height="${height - top - bottom}"/></clipPath>` +
    `<g clip-path="url(#in)">${curves.join("")}</g>` +
    `<text x="${(left + width - right) / 2}" y="${height - 8}" text-anchor="middle">${escaped(xLabel)}</text></svg>`;
}

const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const leastBytes = 1000; // of a video that has a picture

/**
 * Records a canvas while `play` runs, which resolves when it is over; resolves to a WebM Blob.
 * Frames are those that are drawn, 30 a second at most; `draw` draws the last one again until the
 * recorder, which may be slow, has it. Throws where the browser cannot record.
 */
export async function recorded(canvas, draw, play) {
  const type = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"]
    .find((known) => window.MediaRecorder?.isTypeSupported(known));
  if (!type) throw new Error("This browser does not record WebM.");
  const recorder = new MediaRecorder(canvas.captureStream(30), { mimeType: type, videoBitsPerSecond: 8e6 });
  const chunks = [];
  const bytes = () => chunks.reduce((sum, chunk) => sum + chunk.size, 0);
  recorder.addEventListener("dataavailable", (event) => chunks.push(event.data));
  const over = new Promise((resolve) => recorder.addEventListener("stop", resolve));
  recorder.start(200);
  await play();
  for (let i = 0; i < 3 || (i < 50 && bytes() < leastBytes); ++i) {
    await pause(100);
    draw();
  }
  recorder.stop();
  await over;
  return new Blob(chunks, { type: "video/webm" });
}
