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
