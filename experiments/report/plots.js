// Plots over one time axis, with a cursor at the time of the walk.
import uPlot from "uplot";
import * as palette from "./palette.js";

const font = "11px system-ui, sans-serif";
const grid = { stroke: "#e6eaef", width: 1 };
const axis = { font, stroke: "#4a5563", grid, ticks: { stroke: "#c9d1da", size: 4 }, gap: 3 };

function element(name, className, text = "") {
  const made = document.createElement(name);
  made.className = className;
  made.textContent = text;
  return made;
}

// Values of a curve at the times of the plot; null after the walk's end, where nothing is known.
function sampled(curve, walk, times) {
  return Array.from(times, (t) => {
    if (t > walk.duration + 1e-9) return null;
    const value = curve.value(walk, walk.locate(t));
    return Number.isFinite(value) ? value : null;
  });
}

class Plot {
  constructor(parent, spec, walks, last, onSeek, onZoom) {
    this.last = last; // with the numbers of the time axis
    this.spec = spec;
    this.walks = walks;
    const head = element("div", "plot-head");
    const title = element("b", "", spec.title);
    if (spec.hint) title.title = spec.hint;
    head.append(title);
    this.keys = spec.curves.filter((curve) => !curve.quiet).map((curve) => {
      const key = element("span", "key");
      const swatch = element("i", "line");
      swatch.style.background = curve.colour;
      const value = element("span", "value");
      key.append(swatch, element("span", "", curve.label), value);
      head.append(key);
      return { curve, value };
    });
    for (const [label, colour] of spec.keys ?? []) {
      const key = element("span", "key");
      const swatch = element("i", "line");
      swatch.style.background = colour;
      key.append(swatch, element("span", "", label));
      head.append(key);
    }
    this.note = element("span", "note");
    head.append(this.note);
    this.body = element("div", "plot-body");
    this.root = element("div", last ? "plot last" : "plot");
    this.root.append(head, this.body);
    parent.append(this.root);
    this.make(onSeek, onZoom);
  }

  make(onSeek, onZoom) {
    const { spec, walks } = this;
    const longest = walks.reduce((a, b) => (b.duration > a.duration ? b : a));
    const times = longest.times;
    const shown = spec.onlyFirst ? walks.slice(0, 1) : [...walks].reverse();
    const series = [{}];
    const data = [times];
    for (const walk of shown) {
      const first = walk === walks[0];
      for (const curve of spec.curves) {
        series.push({
          stroke: first ? curve.colour : palette.faded(curve.colour, 0.55),
          width: curve.quiet ? 1 : first ? 1.8 : 1.2,
          dash: first ? undefined : [4, 3],
          points: { show: false },
        });
        data.push(sampled(curve, walk, times));
      }
    }
    const range = spec.fixed
      ? () => spec.fixed
      : (_, low, high) => {
          const [least, most] = spec.least ?? [low, high];
          const [a, b] = [Math.min(low ?? 0, least ?? 0), Math.max(high ?? 1, most ?? 1)];
          const pad = Math.max(0.06 * (b - a), 0.004);
          return [spec.least ? a : a - pad, b + pad];
        };
    this.u = new uPlot(
      {
        width: 300,
        height: 100,
        padding: [4, 10, 0, 0],
        legend: { show: false },
        cursor: { show: false },
        scales: { x: { time: false }, y: { range } },
        axes: [
          this.last ? { ...axis, size: 20 } : { ...axis, size: 5, values: (_, s) => s.map(() => "") },
          { ...axis, size: 44, space: 22 },
        ],
        series,
        hooks: { drawAxes: [(u) => this.drawLevel(u)] },
      },
      data,
      this.body,
    );
    this.cursor = element("div", "cursor");
    this.u.over.append(this.cursor);
    const seek = (event) => {
      if (event.buttons !== 1) return;
      onSeek(this.u.posToVal(event.clientX - this.u.over.getBoundingClientRect().left, "x"));
    };
    this.u.over.addEventListener("pointerdown", (event) => {
      this.u.over.setPointerCapture(event.pointerId);
      seek(event);
    });
    this.u.over.addEventListener("pointermove", seek);
    this.u.over.addEventListener("dblclick", () => onZoom(0, longest.duration));
    this.u.over.addEventListener("wheel", (event) => {
      event.preventDefault();
      const { min, max } = this.u.scales.x;
      const at = this.u.posToVal(event.clientX - this.u.over.getBoundingClientRect().left, "x");
      const factor = event.deltaY < 0 ? 0.8 : 1.25;
      const span = Math.min(longest.duration, Math.max(0.2, (max - min) * factor));
      const from = Math.max(0, at - (span * (at - min)) / (max - min));
      onZoom(Math.min(from, longest.duration - span), span);
    }, { passive: false });
  }

  drawLevel(u) {
    if (!this.spec.level) return;
    const y = Math.round(u.valToPos(this.spec.level.value, "y", true));
    u.ctx.save();
    u.ctx.strokeStyle = this.spec.level.colour;
    u.ctx.lineWidth = window.devicePixelRatio;
    u.ctx.setLineDash([6, 4]);
    u.ctx.beginPath();
    u.ctx.moveTo(u.bbox.left, y);
    u.ctx.lineTo(u.bbox.left + u.bbox.width, y);
    u.ctx.stroke();
    u.ctx.restore();
  }

  resize() {
    this.u.setSize({ width: this.body.clientWidth, height: this.body.clientHeight });
    this.showTime(this.t ?? 0);
  }

  showTime(t) {
    this.t = t;
    const walk = this.walks[0];
    const at = walk.locate(t);
    for (const { curve, value } of this.keys) {
      const number = curve.value(walk, at);
      if (curve.text) value.textContent = Number.isFinite(number) ? curve.text(number) : "–";
    }
    if (this.spec.note) this.note.textContent = this.spec.note(walk, at);
    const x = this.u.valToPos(t, "x");
    this.cursor.hidden = !(x >= -1 && x <= this.u.over.clientWidth + 1);
    this.cursor.style.transform = `translateX(${x}px)`;
  }
}

export class Plots {
  constructor(parent, onSeek) {
    this.parent = parent;
    this.onSeek = onSeek;
    this.plots = [];
    new ResizeObserver(() => this.resize()).observe(parent);
  }

  /** Curves of the first walk, and behind them those of the second. */
  show(specs, walks) {
    for (const plot of this.plots) plot.u.destroy();
    this.parent.replaceChildren();
    const zoom = (from, span) => {
      for (const plot of this.plots) {
        plot.u.setScale("x", { min: from, max: from + span });
        plot.showTime(plot.t);
      }
    };
    this.plots = specs.map((spec, i) =>
      new Plot(this.parent, spec, walks, i === specs.length - 1, this.onSeek, zoom));
    const axisLabel = element("div", "axis-label", "time [s]");
    this.parent.append(axisLabel);
    this.resize();
  }

  resize() {
    for (const plot of this.plots) plot.resize();
  }

  showTime(t) {
    for (const plot of this.plots) plot.showTime(t);
  }
}
