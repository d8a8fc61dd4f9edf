// Run of a scene, row by row of its record: it executes the schedule that the library computes.

// numbers of a row before those of the tables
const OWN = 6;

// `scene`: {stop, step, set, changes: [[time, assignments]], tables: [{reference, table: [times, values, period or
// null]}], slopes}; `slopes` is true if tables are interpolated within steps.
export class Run {
  constructor(library, scene) {
    const { stop, step, set, changes, tables, slopes } = scene;
    // rule of the tables: linear within steps, or held
    const rule = slopes ? 0 : 2;
    const points = tables.flatMap(({ table: [times, values, period] }) => [times.length, period ?? 0, rule, ...times, ...values]);
    const width = OWN + 2 * tables.length;
    const rows = library.schedule([stop, step, changes.length, ...changes.map(([time]) => time), ...points], width);
    Object.assign(this, { library, scene, rows, width, place: 0, changed: 0, begun: false, time: 0 });
    library.start([...set, ...this.driven(OWN)], stop);
  }

  // Warnings about the schedule, as texts.
  get warnings() {
    const points = this.rows[0];
    return points === 0 ? [] : [`the run ends a step at each of ${points} points of tables between its communication points, which makes it `
      + "much longer; tables with fewer points make it shorter"];
  }

  get isOver() {
    return this.place + this.width === this.rows.length && !this.begun;
  }

  // Advances to the next row of the record: to the next communication point, or to an earlier jump of inputs. A jump has
  // a second row, with the values after it, to which the run advances without a step.
  advance() {
    for (;;) {
      if (!this.begun) {
        this.place += this.width;
        this.begun = this.set();
        if (this.begun) return;
      }
      this.begun = false;
      const [begin, size, end, , , recorded] = this.rows.subarray(this.place);
      this.library.step(begin, size);
      this.time = end;
      if (recorded) return;
    }
  }

  // Sets the values for a step. Returns true if they jump.
  set() {
    const [, , , due, jumps] = this.rows.subarray(this.place);
    for (; this.changed < due; this.changed += 1) this.library.set(this.scene.changes[this.changed][1]);
    this.library.set(this.driven(OWN));
    if (this.scene.slopes) this.library.setSlopes(this.driven(OWN + this.scene.tables.length));
    return jumps !== 0;
  }

  // Numbers for the inputs that follow tables, starting at index `first` in the row.
  driven(first) {
    return this.scene.tables.map(({ reference }, i) => ({ kind: "Real", reference, value: this.rows[this.place + first + i] }));
  }
}
