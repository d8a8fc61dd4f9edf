// A run of a scene, point by point: the steps of the command `run`, to the same bits.

const SLACK = 1e-9; // times that differ by less than this part of a step are the same

// Value of a table [times, values, period or null] just after a time: straight between points.
export function tableValue([times, values, period], time) {
  const at = period === null ? time : time % period;
  let after = 0;
  while (after < times.length && times[after] <= at) after += 1;
  return between(times, values, at, after);
}

// The same just before a time; that of a period's end is not that of the next one's start.
function valueBefore([times, values, period], time) {
  let at = period === null ? time : time % period;
  if (at === 0 && time > 0) at = period;
  let after = 0;
  while (after < times.length && times[after] < at) after += 1;
  return between(times, values, at, after);
}

// `after`: place of the first point after the time `at`.
function between(times, values, at, after) {
  if (after === 0 || after === times.length) return values[after === 0 ? 0 : after - 1];
  if (times[after] === at) return values[after];
  const share = (at - times[after - 1]) / (times[after] - times[after - 1]);
  return values[after - 1] + share * (values[after] - values[after - 1]);
}

// Slope of a table over a step without jumps, from just after `begin` to just before `end`.
export const tableSlope = (table, begin, end) => (valueBefore(table, end) - tableValue(table, begin)) / (end - begin);

// Times at which a table jumps: two points of one time, and the end of a period whose next one begins with another value.
export class Jumps {
  constructor(table) {
    const [times, , period] = table;
    const inside = times.filter((time, i) => time === times[i + 1] && (period === null || time < period));
    const isAtEnd = period !== null && valueBefore(table, period) !== tableValue(table, 0);
    Object.assign(this, { times: [...new Set([...(isAtEnd ? [0] : []), ...inside])], period, place: 0, round: 0 });
  }

  // The next one; Infinity if there is none.
  get next() {
    if (this.place === this.times.length) return Infinity;
    return this.period === null ? this.times[this.place] : this.round * this.period + this.times[this.place];
  }

  // Passes those up to a time.
  pass(time) {
    while (this.next <= time) {
      this.place += 1;
      if (this.place === this.times.length && this.period !== null) Object.assign(this, { place: 0, round: this.round + 1 });
    }
  }
}

// `scene`: {stop, step, set, changes: [[time, assignments]], tables: [{reference, table}], slopes}; `slopes`: true if tables continue
// straight within steps.
export class Run {
  constructor(library, scene) {
    Object.assign(this, { library, scene, time: 0, done: 0, changes: [...scene.changes] });
    this.jumps = scene.tables.map(({ table }) => new Jumps(table));
    const driven = scene.tables.map(({ reference, table }) => ({ kind: "Real", reference, value: tableValue(table, 0) }));
    library.start([...scene.set, ...driven], scene.stop);
  }

  get isOver() {
    return this.time >= this.scene.stop;
  }

  // On to the next communication point, or to a change of inputs or a jump of a table before it.
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
    for (const jumps of this.jumps) jumps.pass(this.time + slack);
    const change = Math.min(this.changes.length > 0 ? this.changes[0][0] : Infinity, ...this.jumps.map(({ next }) => next));
    if (change < until - slack) until = change;
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
