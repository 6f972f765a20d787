// One walk: columns over time, read at any instant.

function decoded({ step, delta }) {
  const values = new Float64Array(delta.length);
  let sum = 0;
  delta.forEach((change, i) => {
    if (change !== null) sum += change;
    values[i] = change === null ? NaN : sum * step;
  });
  return values;
}

const defaultFamilies = 11; // overlaps, and all that `all_families` adds

/** A method with the variables that it has beside the overlaps. */
export function methodLabel(method, variables) {
  const plain = variables === "" || variables === "overlaps";
  const names = variables.split("+");
  const others = names.filter((name) => name !== "footsteps");
  if (others.length === defaultFamilies) {
    return `${method} (every family${others.length < names.length ? ", footsteps" : ""})`;
  }
  const symbols = names.map((name) =>
    ({ overlaps: "Δ", heights: "η", durations: "T" })[name] ?? name.replaceAll("_", " "));
  return plain ? method : `${method} (${symbols.join(", ")})`;
}

export class Walk {
  constructor(json) {
    this.summary = json.summary;
    this.method = json.summary.method;
    this.variables = json.variables ?? "";
    this.gap = json.gap;
    this.improvements = json.improvements ?? [];
    this.overlaps = json.overlaps ?? [];
    this.halfSteps = json.half_steps ?? [];
    this.certificate = json.certificate;
    this.nearest = json.nearest ?? [];
    this.pareto = json.pareto ?? [];
    this.certified = json.summary.certified === "true" || json.summary.certified === true;
    this.support = json.support ?? "";
    this.parameters = json.parameters ?? null; // of the closed form
    this.columns = { ...json.values }; // those that are not encoded
    this.encoded = json.columns ?? json.values;
    this.drawn = this.encoded !== undefined;
    this.times = this.drawn ? this.column("t_s") : new Float64Array([0]);
    this.duration = this.times[this.times.length - 1];
  }

  get label() {
    return methodLabel(this.method, this.variables);
  }

  /** The same walk, shown as if it lasted `duration` [s]; `summary` tells how long it does. */
  stretchedTo(duration) {
    const factor = duration / this.duration;
    const shown = Object.create(this);
    shown.duration = duration;
    shown.times = this.times.map((t) => factor * t);
    shown.locate = (t) => this.locate(t / factor);
    shown.nearest = this.nearest.map((pair) => ({ ...pair, t_s: factor * pair.t_s }));
    shown.original = this;
    return shown;
  }

  /** NaN where the walk has no such column. */
  column(name) {
    return (this.columns[name] ??= this.encoded[name] ? decoded(this.encoded[name])
      : new Float64Array(this.times.length).fill(NaN));
  }

  /** The row before t and how far t is from it to the next one, from 0 to 1. */
  locate(t) {
    const times = this.times;
    let low = 0;
    let high = times.length - 1;
    if (t >= times[high]) return { row: high, part: 0 };
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= t) low = middle;
      else high = middle;
    }
    const part = Math.max(0, (t - times[low]) / (times[high] - times[low]));
    return { row: low, part };
  }

  /** A column's value at a place that locate() told. */
  value(name, { row, part }) {
    const values = this.column(name);
    return part === 0 ? values[row] : values[row] + part * (values[row + 1] - values[row]);
  }

  /** "left", "right" or "both". */
  supportAt({ row }) {
    return { l: "left", r: "right" }[this.support[row]] ?? "both";
  }

  /** How high the pendulum stands [m]: on z = 0, or where the waist rises with its foot. */
  groundAt(at) {
    const first = { row: 0, part: 0 };
    const lower = Math.min(this.sole("left", first).z, this.sole("right", first).z);
    return lower + this.value("com_z_m", at) - this.value("com_z_m", first);
  }

  sole(side, at) {
    const of = (what) => this.value(`${side}_foot_${what}`, at);
    return { x: of("x_m"), y: of("y_m"), z: of("z_m"), yaw: of("yaw_rad") };
  }

  /** The latest half-step that has begun. */
  halfStepAt(at) {
    return this.halfSteps[Math.round(this.column("half_step")[at.row]) - 1];
  }
}
