// Instants of a motion that came as rows of numbers, read as a Walk is.

/** One row; `columns` are the names of its cells. */
export class Instant {
  constructor(columns) {
    this.index = Object.fromEntries(columns.map((name, i) => [name, i]));
    this.row = null;
    this.rise = NaN; // from the ground to the CoM [m]
  }

  /** How high the pendulum stands [m]; it did so at the lower sole when the first row came. */
  groundAt() {
    if (Number.isNaN(this.rise)) {
      this.rise = this.value("com_z_m") - Math.min(this.sole("left").z, this.sole("right").z);
    }
    return this.value("com_z_m") - this.rise;
  }

  locate() { return {}; }
  value(name) { return this.row[this.index[name]] ?? NaN; }
  supportAt() { return this.row[this.index.support]; }

  sole(side) {
    const of = (what) => this.value(`${side}_foot_${what}`);
    return { x: of("x_m"), y: of("y_m"), z: of("z_m"), yaw: of("yaw_rad") };
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
