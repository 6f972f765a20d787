// Time: play, pause, scrub, speed, keys.
import * as palette from "./palette.js";

const speeds = [0.1, 0.25, 0.5, 1, 2, 4];
const playIcon = "M4 2 L14 8 L4 14 Z";
const pauseIcon = "M3 2 H7 V14 H3 Z M9 2 H13 V14 H9 Z";

function svg(name, attributes) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element;
}

export class Timeline {
  /** Calls onTime(t [s]) whenever the time changes. */
  constructor(onTime) {
    this.onTime = onTime;
    this.t = 0;
    this.duration = 1;
    this.playing = false;
    this.onPause = () => {};
    this.scrub = document.getElementById("scrub");
    this.clock = document.getElementById("clock");
    this.speed = document.getElementById("speed");
    for (const value of speeds) this.speed.add(new Option(String(value), value));
    this.speed.value = "1";
    this.icon = svg("path", { d: playIcon });
    const image = svg("svg", { viewBox: "0 0 16 16", width: 16, height: 16 });
    image.append(this.icon);
    this.button = document.getElementById("play");
    this.button.append(image);
    this.button.addEventListener("click", () => this.toggle());
    this.scrub.addEventListener("input", () => {
      // The slider's last place is the end, but for what its text loses of the number.
      const at = Number(this.scrub.value);
      this.seek(at > this.duration - 1e-6 ? this.duration : at);
    });
    window.addEventListener("keydown", (event) => this.key(event));
  }

  /** The end has moved to `duration`; goes there where that is followed. */
  extend(duration, follow) {
    this.duration = duration;
    this.scrub.max = duration;
    this.seek(follow ? duration : this.t);
  }

  setDuration(duration) {
    this.duration = duration;
    this.scrub.max = duration;
    this.seek(Math.min(this.t, duration));
  }

  seek(t) {
    this.t = Math.max(0, Math.min(this.duration, t));
    this.scrub.value = this.t;
    this.clock.textContent = `${this.t.toFixed(2)} / ${this.duration.toFixed(2)} s`;
    this.onTime(this.t);
  }

  toggle(playing = !this.playing) {
    if (playing && this.t >= this.duration) this.seek(0);
    this.playing = playing;
    this.icon.setAttribute("d", playing ? pauseIcon : playIcon);
    this.button.setAttribute("aria-label", playing ? "Pause" : "Play");
    let before = null;
    const frame = (now) => {
      if (!this.playing) return;
      if (before !== null) this.seek(this.t + ((now - before) / 1000) * Number(this.speed.value));
      before = now;
      if (this.t >= this.duration) this.toggle(false);
      else requestAnimationFrame(frame);
    };
    if (playing) requestAnimationFrame(frame);
    else this.onPause();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (/^(SELECT|TEXTAREA)$/.test(event.target.tagName) || document.querySelector("dialog[open]")) return;
    if (event.target.type === "range" && event.target !== this.scrub) return; // another slider
    if (event.key === " " && event.target.tagName === "BUTTON" && event.target !== this.button) return;
    const step = event.shiftKey ? 0.5 : 0.05;
    const action = {
      " ": () => this.toggle(),
      ArrowLeft: () => this.seek(this.t - step),
      ArrowRight: () => this.seek(this.t + step),
      Home: () => this.seek(0),
      End: () => this.seek(this.duration),
    }[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  /** Strips that say which foot carries, a row for each walk. */
  showPhases(walks) {
    const strips = walks.map((walk) => {
      const strip = svg("svg", { viewBox: `0 0 ${this.duration} 1`, preserveAspectRatio: "none" });
      let from = 0;
      for (let i = 1; i <= walk.support.length; ++i) {
        if (i < walk.support.length && walk.support[i] === walk.support[from]) continue;
        const begin = walk.times[from];
        const end = walk.times[Math.min(i, walk.times.length - 1)];
        const fill = { l: palette.left, r: palette.right }[walk.support[from]] ?? "#ccd3db";
        strip.append(svg("rect", { x: begin, y: 0, width: end - begin, height: 1, fill }));
        from = i;
      }
      return strip;
    });
    document.getElementById("phases").replaceChildren(...strips);
  }
}
