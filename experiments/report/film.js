// A video of the view that is drawn frame by frame at fixed instants: as smooth on a slow machine.
import * as palette from "./palette.js";
import { webmCluster, webmHead } from "./webm.js";

const framesPerKey = 60;
const kinds = [["vp09.00.40.08", "V_VP9"], ["vp8", "V_VP8"]];

async function chosenEncoding(width, height, rate) {
  for (const [codec, name] of window.VideoEncoder ? kinds : []) {
    const config = { codec, width, height, framerate: rate, bitrate: 6e6 };
    const { supported } = await VideoEncoder.isConfigSupported(config).catch(() => ({}));
    if (supported) return { config, name };
  }
  throw new Error("This browser encodes no WebM.");
}

// The view with what stands beside it in the page: who walks, and when.
class Picture {
  constructor(canvas) {
    this.view = canvas;
    this.canvas = document.createElement("canvas");
    this.canvas.width = canvas.width - (canvas.width % 2);
    this.canvas.height = canvas.height - (canvas.height % 2);
    this.pen = this.canvas.getContext("2d");
    this.unit = this.canvas.height / 720;
  }

  // `x`: from the left edge, or from the right one where it is negative.
  label(text, x, y, colour) {
    const { pen, unit } = this;
    pen.font = `${20 * unit}px "DejaVu Sans", sans-serif`;
    const width = pen.measureText(text).width + 22 * unit;
    const left = x < 0 ? this.canvas.width + x - width : x;
    pen.fillStyle = palette.faded(palette.theme.page, 0.85);
    pen.fillRect(left, y, width, 32 * unit);
    if (colour) {
      pen.fillStyle = colour;
      pen.fillRect(left, y, 5 * unit, 32 * unit);
    }
    pen.fillStyle = palette.theme.ink;
    pen.fillText(text, left + 13 * unit, y + 23 * unit);
  }

  draw({ names: [a, b], beside, clock }) {
    const { width, height } = this.canvas;
    const edge = 12 * this.unit;
    this.pen.drawImage(this.view, 0, 0);
    if (beside) {
      this.pen.fillStyle = palette.grey;
      this.pen.fillRect(width / 2, 0, 1, height);
    }
    if (a) this.label(a, edge, edge, palette.left);
    if (b && beside) this.label(b, width / 2 + edge, edge, palette.second);
    else if (b) this.label(b, edge, edge + 40 * this.unit, palette.second);
    this.label(clock, -edge, height - edge - 32 * this.unit);
  }
}

export class Film {
  /**
   * A film of the instants from `from` to `to` [s] that lasts `seconds`, of `rate` frames a second.
   * `page` has: canvas, show(t), which draws the instant t at once, and captions(), {names, beside, clock}.
   */
  static async begin(page, from, to, seconds, rate = 30) {
    page.show(from);
    const film = new Film();
    film.page = page;
    film.picture = new Picture(page.canvas);
    const { width, height } = film.picture.canvas;
    const { config, name } = await chosenEncoding(width, height, rate);
    film.rate = rate;
    film.frames = Math.max(2, Math.round(seconds * rate) + 1);
    film.done = 0;
    film.instant = (frame) => from + ((to - from) * frame) / (film.frames - 1);
    film.parts = [webmHead({ codec: name, width, height, duration: film.frames / rate })];
    film.cluster = [];
    film.encoder = new VideoEncoder({
      output: (chunk) => film.take(chunk),
      error: (error) => { film.failure = error; },
    });
    film.encoder.configure(config);
    return film;
  }

  // Frames come in their order; a cluster begins with a key frame.
  take(chunk) {
    const bytes = new Uint8Array(chunk.byteLength);
    chunk.copyTo(bytes);
    const key = chunk.type === "key";
    if (key) this.endCluster();
    this.cluster.push({ time: Math.round(chunk.timestamp / 1000), key, bytes });
  }

  endCluster() {
    if (this.cluster.length > 0) this.parts.push(webmCluster(this.cluster));
    this.cluster = [];
  }

  /** Draws and encodes the next `count` frames; all are done when `done` is `frames`. */
  async next(count) {
    for (let i = 0; i < count && this.done < this.frames; ++i, ++this.done) {
      this.page.show(this.instant(this.done));
      this.picture.draw(this.page.captions());
      const frame = new VideoFrame(this.picture.canvas, {
        timestamp: Math.round((this.done * 1e6) / this.rate), duration: Math.round(1e6 / this.rate),
      });
      this.encoder.encode(frame, { keyFrame: this.done % framesPerKey === 0 });
      frame.close();
      while (this.encoder.encodeQueueSize > 4) await new Promise((resolve) => setTimeout(resolve, 1));
      if (this.failure) throw this.failure;
    }
    if (this.done < this.frames) return;
    await this.encoder.flush();
    this.encoder.close();
    if (this.failure) throw this.failure;
    this.endCluster();
  }

  /** The file's parts that are new since the last call. */
  takeParts() {
    const parts = this.parts;
    this.parts = [];
    return parts;
  }
}

function base64(parts) {
  let text = "";
  for (const part of parts) {
    for (let i = 0; i < part.length; i += 8192) text += String.fromCharCode(...part.subarray(i, i + 8192));
  }
  return btoa(text);
}

/**
 * What `halfstep report --video` drives: begin({seconds, show, rate}) resolves to {frames}, or to
 * {unknown}, a sentence, where the page knows nothing of what shall be shown; next(count) to
 * {done, bytes}, the frames that are done and the file's next bytes. The view fills the window.
 * `page` has what Film asks for, duration(), and show(address), which returns undefined or the
 * sentence.
 */
export function filmByCommand(page) {
  let film = null;
  return {
    async begin({ seconds, show, rate }) {
      if (!page.hasView()) throw new Error("This browser has no WebGL: the walk is not drawn.");
      document.body.classList.add("film");
      const unknown = page.choose(show);
      if (unknown) return { unknown };
      film = await Film.begin(page, page.begin(), page.duration(), seconds ?? page.duration() - page.begin(),
                              rate);
      return { frames: film.frames };
    },
    async next(count) {
      await film.next(count);
      return { done: film.done, bytes: base64(film.takeParts()) };
    },
  };
}
