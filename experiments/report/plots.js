// Plots over one time axis, with a cursor at the time of the walk.
import uPlot from "uplot";
import { element, lineKey } from "./elements.js";
import * as palette from "./palette.js";
import { figureSvg } from "./figure_svg.js";
import { fileName, plotPng, save } from "./saving.js";

const font = "11px system-ui, sans-serif";

/** An axis in the colours of the theme. */
export function themedAxis() {
  const { lines, numbers, ticks } = palette.theme;
  return { font, labelFont: font, stroke: numbers, grid: { stroke: lines, width: 1 },
           ticks: { stroke: ticks, size: 4 }, gap: 3 };
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
  constructor(parent, spec, walks, last, kept, onSeek, onZoom) {
    this.last = last; // with the numbers of the time axis
    this.spec = spec;
    this.walks = walks;
    this.kept = kept; // {hidden, picked}: names of curves that are not shown, and the one that is picked
    this.hidden = kept.hidden;
    const head = element("div", { className: "plot-head" });
    head.append(element("b", { text: spec.title, title: spec.hint }));
    this.keys = spec.curves.filter((curve) => !curve.quiet).map((curve) => {
      const value = element("span", { className: "value" });
      const button = this.key(curve.label, curve.colour);
      button.append(value);
      head.append(button);
      return { curve, value, name: curve.label, button };
    });
    if (spec.picks) head.append(this.picker());
    this.note = element("span", { className: "note" });
    head.append(this.note, element("span", { className: "savers" }, this.saver("PNG"), " ", this.saver("SVG")));
    this.body = element("div", { className: "plot-body" });
    this.root = element("div", { className: last ? "plot last" : "plot" });
    this.root.append(head, this.body);
    parent.append(this.root);
    this.make(onSeek, onZoom);
    this.showCurves();
  }

  // The choice of the curve that is shown before all others: at first the one that goes highest.
  picker() {
    const { picks } = this.spec;
    const most = picks.map((pick) => pick.most(this.walks[0]));
    const highest = picks[most.indexOf(Math.max(...most))] ?? picks[0];
    this.picked = picks.find(({ name }) => name === this.kept.picked) ?? highest;
    const select = element("select", { className: "pick" });
    select.setAttribute("aria-label", `${this.spec.title}: joint`);
    picks.forEach(({ name }, i) => select.add(new Option(`${name}, up to ${most[i].toFixed(2)}`, name)));
    select.value = this.picked.name;
    this.swatch = element("i", { className: "line" });
    this.swatch.style.background = this.picked.colour;
    select.addEventListener("change", () => {
      this.picked = picks.find(({ name }) => name === select.value);
      this.kept.picked = this.picked.name;
      this.swatch.style.background = this.picked.colour;
      this.u.setData(this.data(), false);
      this.u.redraw();
      this.showTime(this.t ?? 0);
    });
    return element("span", { className: "key" }, this.swatch, select);
  }

  // Times, and the values of each curve at them.
  data() {
    return [this.times, ...this.curveOf.map(({ curve, walk }) => sampled(curve, walk, this.times))];
  }

  // A click hides a curve or shows it; with shift, or twice, it is shown alone, or all are again.
  key(name, colour) {
    const button = lineKey(colour, name, "button");
    button.title = `${name}: hide or show; with shift: alone`;
    button.addEventListener("click", (event) => {
      const others = this.keys.map((key) => key.name).filter((n) => n !== name);
      if (event.shiftKey) {
        const alone = !this.hidden.has(name) && others.every((other) => this.hidden.has(other));
        this.hidden.clear();
        if (!alone) for (const other of others) this.hidden.add(other);
      } else if (!this.hidden.delete(name)) {
        this.hidden.add(name);
      }
      this.showCurves();
    });
    return button;
  }

  // Of each series; of B's, and of those that are in the background, none.
  names() {
    return this.curveOf.map(({ curve, walk }) =>
      (walk !== this.walks[0] || curve.quiet ? "" : curve.both ? this.picked.name : curve.label));
  }

  saver(kind) {
    const button = element("button", { text: kind, className: "save", title: `save this plot as ${kind}` });
    button.addEventListener("click", async () => {
      save(kind === "PNG" ? await plotPng(this.u, this.spec.title)
        : new Blob([figureSvg(this.u, this.names(), this.spec.axis ?? this.spec.title)], { type: "image/svg+xml" }),
           fileName(this.spec.title, kind.toLowerCase()));
    });
    return button;
  }

  showCurves() {
    for (const { name, button } of this.keys) {
      button.setAttribute("aria-pressed", String(!this.hidden.has(name)));
    }
    this.u.batch(() => this.curveOf.forEach(({ curve }, i) => {
      const show = !this.hidden.has(curve.label);
      if (this.u.series[i + 1].show !== show) this.u.setSeries(i + 1, { show });
    }));
  }

  make(onSeek, onZoom) {
    const { spec, walks } = this;
    const longest = walks.reduce((a, b) => (b.duration > a.duration ? b : a));
    this.times = longest.times;
    const series = [{}];
    const axis = themedAxis();
    this.curveOf = []; // {curve, walk} of each series
    const picked = spec.picks && {
      label: "", both: true, value: (walk, at) => this.picked.value(walk, at),
      get colour() { return this.of.picked.colour; }, of: this,
    };
    for (const walk of [...walks].reverse()) {
      const first = walk === walks[0];
      for (const curve of [...spec.curves, ...(picked ? [picked] : [])]) {
        if (!first && spec.onlyFirst && !curve.both) continue;
        series.push({
          stroke: () => (first ? curve.colour : palette.faded(curve.colour, 0.55)),
          width: curve.quiet ? 1 : first ? 1.8 : 1.2,
          dash: first ? undefined : [4, 3],
          points: { show: false },
        });
        this.curveOf.push({ curve, walk });
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
      this.data(),
      this.body,
    );
    this.cursor = element("div", { className: "cursor" });
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
    if (this.picked) {
      this.note.textContent = this.picked.note(walk, at);
      this.note.title = this.picked.hint;
    }
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
    this.kept = new Map(); // by a plot's title
    new ResizeObserver(() => this.resize()).observe(parent);
  }

  /** Curves of the first walk, and behind them those of the second; `label` is of the time axis. */
  show(specs, walks, label = "time [s]") {
    for (const plot of this.plots) plot.u.destroy();
    this.parent.replaceChildren();
    const zoom = (from, span) => {
      for (const plot of this.plots) {
        plot.u.setScale("x", { min: from, max: from + span });
        plot.showTime(plot.t);
      }
    };
    this.plots = specs.map((spec, i) => {
      if (!this.kept.has(spec.title)) this.kept.set(spec.title, { hidden: new Set(spec.hidden), picked: null });
      const last = i === specs.length - 1;
      return new Plot(this.parent, spec, walks, last, this.kept.get(spec.title), this.onSeek, zoom);
    });
    this.parent.append(element("div", { className: "axis-label", text: label }));
    this.resize();
  }

  resize() {
    for (const plot of this.plots) plot.resize();
  }

  showTime(t) {
    for (const plot of this.plots) plot.showTime(t);
  }
}
