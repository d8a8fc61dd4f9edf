// A run of a scene, point by point: the steps of the command `run`, to the same bits.

const SLACK = 1e-9; // times that differ by less than this part of a step are the same

// Value of a table [times, values, period or null] just after a time: straight between points.
export function tableValue([times, values, period], time) {
  const at = period === null ? time : time % period;
  let after = 0;
  while (after < times.length && times[after] <= at) after += 1;
  if (after === 0 || after === times.length) return values[after === 0 ? 0 : after - 1];
  const share = (at - times[after - 1]) / (times[after] - times[after - 1]);
  return values[after - 1] + share * (values[after] - values[after - 1]);
}

// Slope of a table from just after `begin` to just before `end`; a value that jumps between them, or begins anew, is held.
export function tableSlope(table, begin, end) {
  const [times, , period] = table;
  const [from, to] = [begin, end].map((time) => (period === null ? time : time % period));
  const anew = to < from || (period !== null && end - begin >= period);
  const jumps = times.some((time, i) => time === times[i + 1] && from < time && time <= to);
  return anew || jumps ? 0 : (tableValue(table, end) - tableValue(table, begin)) / (end - begin);
}

// `scene`: {stop, step, set, changes: [[time, assignments]], tables: [{reference, table}], slopes}; `slopes`: whether tables go on
// straight within steps.
export class Run {
  constructor(library, scene) {
    Object.assign(this, { library, scene, time: 0, done: 0, changes: [...scene.changes] });
    const driven = scene.tables.map(({ reference, table }) => ({ kind: "Real", reference, value: tableValue(table, 0) }));
    library.start([...scene.set, ...driven], scene.stop);
  }

  get isOver() {
    return this.time >= this.scene.stop;
  }

  // On to the next communication point, or to a change of inputs before it.
  advance() {
    const { stop, step, tables, slopes } = this.scene;
    const slack = SLACK * step;
    while (this.changes.length > 0 && this.changes[0][0] <= this.time + slack) this.library.set(this.changes.shift()[1]);
    if (tables.length > 0) {
      const value = (table) => tableValue(table, this.time + slack);
      this.library.set(tables.map(({ reference, table }) => ({ kind: "Real", reference, value: value(table) })));
    }
    const regular = (this.done + 1) * step;
    let until = regular > stop - slack ? stop : regular;
    if (this.changes.length > 0 && this.changes[0][0] < until - slack) until = this.changes[0][0];
    else this.done += 1;
    if (slopes) {
      const slope = (table) => tableSlope(table, this.time + slack, until - slack);
      this.library.setSlopes(tables.map(({ reference, table }) => ({ reference, value: slope(table) })));
    }
    // point and size are numbers whose sum is not rounded
    const size = until - this.time;
    this.library.step(until - size, size);
    this.time = until;
  }
}
