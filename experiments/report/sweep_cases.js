// The cases of a sweep: what varies, and what each method came to.

const units = [["_rad_s", "rad/s"], ["_m_s2", "m/s²"], ["_m_s", "m/s"], ["_n_m", "N m"], ["_deg", "°"],
               ["_rad", "rad"], ["_kg", "kg"], ["_s", "s"], ["_m", "m"]];

/** A key with its unit, which is the end of its name: half_step.duration_s → half_step.duration [s]. */
export function keyLabel(key) {
  const [end, unit] = units.find(([suffix]) => key.endsWith(suffix)) ?? ["", ""];
  return unit ? `${key.slice(0, -end.length)} [${unit}]` : key;
}

const number = (words) => (words.trim() === "" ? NaN : Number(words));

/** Keys that advance together. Values are rising where they are numbers. */
class Axis {
  constructor({ keys, values, stride, of, at }) {
    this.keys = keys;
    this.of = of; // number of values before any were left out
    this.stride = stride; // which was every stride-th of them
    this.label = keys.map(keyLabel).join(" & ");
    const numbers = values.map(([first]) => number(first));
    this.isNumeric = numbers.every(Number.isFinite);
    const order = values.map((_, i) => i);
    if (this.isNumeric) order.sort((i, j) => numbers[i] - numbers[j]);
    const rank = [];
    order.forEach((i, k) => { rank[i] = k; });
    this.texts = order.map((i) => values[i].map((words) =>
      (Number.isFinite(number(words)) ? String(number(words)) : words)).join(", "));
    this.numbers = order.map((i) => numbers[i]);
    this.at = at.map((i) => rank[i]);
  }

  get size() {
    return this.texts.length;
  }
}

/** What is looked at: its name with unit, and value(tables, method, case). */
export const quantities = [
  { name: "duration", label: "duration of the walk [s]",
    value: (cases, m, i) => cases.tables[m].duration[i] },
  { name: "speedup", label: "speed-up over raw [×]", needsRaw: true,
    value: (cases, m, i) => cases.tables[cases.raw].duration[i] / cases.tables[m].duration[i] },
  { name: "excess", label: "longer than the case's shortest walk [%]",
    value: (cases, m, i) => 100 * (cases.tables[m].duration[i] / cases.shortest[i] - 1) },
  { name: "bound", label: "longer than the lower bound [%]", needsBound: true,
    value: (cases, m, i) => (cases.tables[m].gap_lipm[i] === null ? null
      : 100 * cases.tables[m].gap_lipm[i]) },
  { name: "effort", label: "effort",
    value: (cases, m, i) => cases.tables[m].effort[i] },
  { name: "candidates", label: "candidates",
    value: (cases, m, i) => cases.tables[m].iterations[i] },
];

export class Cases {
  constructor(data) {
    Object.assign(this, { ids: data.ids, methods: data.methods, tables: data.tables,
      statuses: data.statuses, families: data.families, messages: data.messages,
      meanings: data.meanings, notRepeatable: data.not_repeatable, place: data.place });
    this.axes = data.axes.map((axis) => new Axis(axis));
    this.reports = new Set(data.reports);
    this.raw = this.methods.indexOf("raw");
    if (this.methods.length === 0) this.methods = ["none"]; // no case has a walk
    this.shortest = this.ids.map((_, i) => this.tables.reduce((least, table) =>
      (table.solved[i] ? Math.min(least, table.duration[i]) : least), Infinity));
    const bounded = this.tables.some((table) => "gap_lipm" in table);
    this.quantities = quantities.filter((what) =>
      (!what.needsRaw || this.raw >= 0) && (!what.needsBound || bounded));
  }

  /** Whether the method has a row in the case. */
  has(m, i) {
    return this.tables[m].status[i] !== null;
  }

  /** Its value where it has a proved walk of its own, else null. */
  value(what, m, i) {
    return this.tables[m].solved[i] ? what.value(this, m, i) : null;
  }

  /** Cases with the value k of each axis: `fixed` has an index or undefined for each axis. */
  where(fixed) {
    const list = [];
    for (let i = 0; i < this.ids.length; ++i) {
      if (fixed.every((k, axis) => k === undefined || this.axes[axis].at[i] === k)) list.push(i);
    }
    return list;
  }

  /** Folder of a case, as an address relative to the page. */
  folder(i) {
    return [...this.place.split("/"), this.ids[i]].map(encodeURIComponent).join("/");
  }
}

/** Several cases as one: how many there are, how many of them are solved, and their median. */
export function together(cases, what, m, list) {
  const there = list.filter((i) => cases.has(m, i));
  const values = there.map((i) => cases.value(what, m, i)).filter((value) => value !== null)
    .sort((a, b) => a - b);
  const middle = values.length >> 1;
  return {
    list: there, all: there.length, solved: values.length,
    low: values[0], high: values.at(-1),
    value: values.length === 0 ? null
      : values.length % 2 ? values[middle] : (values[middle - 1] + values[middle]) / 2,
  };
}
