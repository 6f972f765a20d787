// Instants of a motion that came as rows of numbers, read as a Walk is.

const mostRows = 40000; // what is older is forgotten

/** The messages `state` of a live robot, in the order of time; read as a Walk is. */
export class Past {
  constructor(columns) {
    this.index = Object.fromEntries(columns.map((name, i) => [name, i]));
    this.states = [];
    this.rise = NaN; // from the ground to the CoM [m]
  }

  add(state) {
    this.states.push(state);
    if (this.states.length > mostRows) this.states.splice(0, mostRows / 2);
  }

  get begin() { return this.states[0]?.t_s ?? 0; }
  get duration() { return this.states.at(-1)?.t_s ?? 0; }

  locate(t) {
    const { states } = this;
    let low = 0;
    let high = states.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (states[middle].t_s <= t) low = middle;
      else high = middle;
    }
    if (t >= states[high].t_s) return { row: high, part: 0 };
    return { row: low, part: Math.max(0, (t - states[low].t_s) / (states[high].t_s - states[low].t_s)) };
  }

  stateAt(t) { return this.states[this.locate(t).row]; }

  value(name, { row, part }) {
    const of = (i) => this.states[i].row[this.index[name]] ?? NaN;
    return part === 0 ? of(row) : of(row) + part * (of(row + 1) - of(row));
  }

  supportAt({ row }) { return this.states[row].row[this.index.support]; }

  /** How high the pendulum stands [m]; it did so at the lower sole when the first row came. */
  groundAt(at) {
    if (Number.isNaN(this.rise)) {
      this.rise = this.value("com_z_m", at) - Math.min(this.sole("left", at).z, this.sole("right", at).z);
    }
    return this.value("com_z_m", at) - this.rise;
  }

  sole(side, at) {
    const of = (what) => this.value(`${side}_foot_${what}`, at);
    return { x: of("x_m"), y: of("y_m"), z: of("z_m"), yaw: of("yaw_rad") };
  }

  /** Rows from a time on, for `span` [s]. */
  rowsFrom(from, span) {
    return this.states.slice(this.locate(from).row, this.locate(from + span).row + 1).map(({ row }) => row);
  }
}

/** Rows `period` [s] apart. */
export class Rows {
  constructor(columns, rows) {
    this.index = Object.fromEntries(columns.map((name, i) => [name, i]));
    this.rows = rows;
  }

  column(name) { return this.rows.map((row) => row[this.index[name]] ?? NaN); }
  value(name, row) { return this.rows[row][this.index[name]] ?? NaN; }
  supportAt({ row }) { return this.rows[row][this.index.support]; }
  get length() { return this.rows.length; }
}

/** The rows of a walk from a time on, for `span` [s]. */
export function rowsOf(walk, from, span) {
  const first = walk.locate(from).row;
  const last = walk.locate(from + span).row;
  return {
    column: (name) => walk.column(name).slice(first, last + 1),
    value: (name, row) => walk.column(name)[first + row],
    supportAt: ({ row }) => walk.supportAt({ row: first + row }),
    length: last + 1 - first,
  };
}
