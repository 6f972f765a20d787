// What the reader does beside looking: links, pictures, videos, keys.
import { copyAddress } from "./address.js";
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

async function saveVideo({ stage, timeline, draw }) {
  if (!stage) return tell("There is no view to record.");
  byId("record").disabled = true;
  tell("Recording …");
  try {
    const blob = await recorded(byId("canvas"), draw, () => new Promise((resolve) => {
      timeline.onPause = resolve;
      timeline.toggle(true);
    }));
    save(blob, fileName(document.title, "webm"));
    tell("");
  } catch (error) {
    tell(error.message);
  }
  timeline.onPause = () => {};
  byId("record").disabled = false;
  return undefined;
}

/**
 * Buttons below the view, and their keys. `page` has: stage or null, timeline, draw(), which draws
 * at once, goToWorst(), and addressNow(), what is looked at.
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
    ({ w: goToWorst, c: copy, "?": help })[event.key]?.();
  });
}
