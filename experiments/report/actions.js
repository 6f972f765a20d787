// What the reader does beside looking: links, pictures, videos, keys.
import { copyAddress } from "./address.js";
import { Film } from "./film.js";
import { fileName, recorded, save } from "./saving.js";

const byId = (id) => document.getElementById(id);
const tell = (text) => { byId("told").textContent = text; };

async function savePicture({ stage, timeline, draw }) {
  if (!stage) return tell("There is no view to save.");
  draw(); // the canvas keeps its picture only until the browser has shown it
  const blob = await new Promise((resolve) => byId("canvas").toBlob(resolve, "image/png"));
  save(blob, fileName(`${document.title} ${timeline.t.toFixed(2)} s`, "png"));
  return tell("");
}

// Frame by frame where the browser can encode, else as it plays.
async function videoOf(page) {
  const { timeline } = page;
  if (!window.VideoEncoder) {
    return recorded(byId("canvas"), page.draw, () => new Promise((resolve) => {
      timeline.onPause = resolve;
      timeline.toggle(true);
    }));
  }
  timeline.toggle(false);
  const from = timeline.t < timeline.duration ? timeline.t : 0;
  const seconds = (timeline.duration - from) / Number(byId("speed").value);
  const film = await Film.begin(page.film, from, timeline.duration, seconds);
  while (film.done < film.frames) {
    await film.next(5);
    tell(`Recording: frame ${film.done} of ${film.frames}`);
    await new Promise((resolve) => setTimeout(resolve));
  }
  return new Blob(film.takeParts(), { type: "video/webm" });
}

async function saveVideo(page) {
  if (!page.stage) return tell("There is no view to record.");
  byId("record").disabled = true;
  tell("Recording …");
  try {
    save(await videoOf(page), fileName(document.title, "webm"));
    tell("");
  } catch (error) {
    tell(error.message);
  }
  page.timeline.onPause = () => {};
  byId("record").disabled = false;
  return undefined;
}

/**
 * Buttons below the view, and their keys. `page` has: stage or null, timeline, draw(), which draws
 * at once, goToWorst(), toggleVolumes(), addressNow(), what is looked at, and film, the page of a Film.
 */
export function connectActions(page) {
  const { goToWorst } = page;
  const copy = async () => tell(await copyAddress(page.addressNow()));
  const help = () => { if (!byId("help").open) byId("help").showModal(); };
  for (const [id, action] of [["worst", goToWorst], ["link", copy], ["picture", () => savePicture(page)],
                              ["record", () => saveVideo(page)], ["keys", help]]) {
    byId(id).addEventListener("click", action);
  }
  window.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || byId("help").open) return;
    if (event.target.tagName === "SELECT") return;
    ({ w: goToWorst, c: copy, v: page.toggleVolumes, "?": help })[event.key]?.();
  });
}
