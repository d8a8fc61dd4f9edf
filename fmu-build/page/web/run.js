// Run of a scene, point by point: it executes the schedule that the library computes.

// `scene`: {stop, step, set, changes: [[time, assignments]], tables: [{reference, table: [times, values, period or
// null]}], slopes}; `slopes` is true if tables are interpolated within steps.
export class Run {
  constructor(library, scene) {
    const { stop, step, set, changes, tables } = scene;
    const points = tables.flatMap(({ table: [times, values, period] }) => [times.length, period ?? 0, 0, ...times, ...values]);
    const width = 4 + 2 * tables.length;
    const rows = library.schedule([stop, step, changes.length, ...changes.map(([time]) => time), ...points], width);
    Object.assign(this, { library, scene, rows, width, place: 0, changed: 0 });
    library.start([...set, ...this.driven(4)], stop);
  }

  get time() {
    return this.rows[this.place + 2];
  }

  get isOver() {
    return this.place + this.width === this.rows.length;
  }

  // Advances to the next communication point.
  advance() {
    this.place += this.width;
    const [begin, size, , due] = this.rows.subarray(this.place);
    for (; this.changed < due; this.changed += 1) this.library.set(this.scene.changes[this.changed][1]);
    this.library.set(this.driven(4));
    if (this.scene.slopes) this.library.setSlopes(this.driven(4 + this.scene.tables.length));
    this.library.step(begin, size);
  }

  // Numbers for the inputs that follow tables, starting at index `first` in the row.
  driven(first) {
    return this.scene.tables.map(({ reference }, i) => ({ kind: "Real", reference, value: this.rows[this.place + first + i] }));
  }
}
