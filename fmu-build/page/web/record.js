// Record of a run: which outputs it contains, its points, and a file of them.
import { pairNames } from "./contact.js";
import { driveOutputs } from "./final_drive.js";
import { element } from "./frame.js";
import { clutchOutputs } from "./half_shafts.js";
import { clamp } from "./table.js";

const MOVING = ["mesh.frequency", "carrier.angle", "carrier.speed", "solver.energy_residual"];
const SIDES = ["left", "right"];

export const planetNames = (count) => Array.from({ length: count }, (_, i) => `planet[${i + 1}]`);

// True if a gear set of `count` planets has the variable: false for variables of further planets.
export const isThere = (name, count) => !(Number(/^planet\[(\d+)\]/.exec(name)?.[1]) > count);

export const heats = (table) => table.outputs().map(({ name }) => name).filter((name) => name.startsWith("heat."));

const planets = (setup) => planetNames(setup.value("geometry.planet_count"));

export const forces = (setup) => planets(setup).flatMap((planet) => SIDES.map((side) => `${planet}.${side}_normal_force`));

// Outputs that a run records at each point: only those for the picture, the values, the traces and the colours.
// `colours` are the outputs for the colour mode; `withPressures` adds the pressures of tooth pairs.
export function recorded(setup, colours, withPressures) {
  const { table } = setup;
  const sides = SIDES.flatMap((side) => [`${side}.angle`, `${side}.speed`, `${side}.twist`, `${side}.tangential_force`]);
  const spins = planets(setup).map((planet) => `${planet}.spin_angle`);
  const names = [...MOVING, ...driveOutputs(setup), ...clutchOutputs(setup), ...sides, ...spins, ...forces(setup), ...heats(table), ...setup.shown(),
    ...pairNames(withPressures), ...colours];
  return [...new Set(names)].filter((name) => table.find(name));
}

// Position of a time between two others, from 0 to 1; 0 if these are equal.
export const between = (time, from, to) => (to > from ? clamp((time - from) / (to - from), 0, 1) : 0);

// Growing columns of numbers, interpolated linearly at any time.
export class Record {
  constructor(names) {
    this.place = new Map(names.map((name, i) => [name, i + 1]));
    this.count = 0;
    this.columns = Array.from({ length: names.length + 1 }, () => new Float64Array(1024));
  }

  // `points`: consecutive rows of time and values.
  append(points) {
    const width = this.columns.length;
    const rows = points.length / width;
    if (this.count + rows > this.columns[0].length) {
      const room = 2 * (this.count + rows);
      this.columns = this.columns.map((column) => {
        const wider = new Float64Array(room);
        wider.set(column.subarray(0, this.count));
        return wider;
      });
    }
    for (let row = 0; row < rows; row += 1) {
      for (let k = 0; k < width; k += 1) this.columns[k][this.count + row] = points[row * width + k];
    }
    this.count += rows;
  }

  get times() {
    return this.columns[0].subarray(0, this.count);
  }

  get end() {
    return this.times.at(-1) ?? 0;
  }

  has(name) {
    return this.place.has(name);
  }

  column(name) {
    return this.columns[this.place.get(name)].subarray(0, this.count);
  }

  // Sets the time for `value(name)`.
  seek(time) {
    const times = this.columns[0];
    let low = 0;
    let high = Math.max(this.count - 1, 0);
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= time) low = middle;
      else high = middle;
    }
    Object.assign(this, { low, high, share: between(time, times[low], times[high]) });
  }

  value(name) {
    const place = this.place.get(name);
    if (place === undefined || this.count === 0) return 0;
    const column = this.columns[place];
    return column[this.low] + this.share * (column[this.high] - column[this.low]);
  }

  // Value at the last point before the time, for quantities that must not be interpolated.
  point(name) {
    const place = this.place.get(name);
    return place === undefined || this.count === 0 ? 0 : this.columns[place][this.share < 1 ? this.low : this.high];
  }

  // Rate of change between the points around the time [1/s].
  rate(name) {
    const place = this.place.get(name);
    const width = this.columns[0][this.high] - this.columns[0][this.low];
    return place === undefined || !(width > 0) ? 0 : (this.columns[place][this.high] - this.columns[place][this.low]) / width;
  }

  // Largest magnitude of a column so far.
  largest(name) {
    return this.has(name) ? this.column(name).reduce((most, value) => Math.max(most, Math.abs(value)), 0) : 0;
  }
}

// Offers columns of a record as a download for a table or a script, with the columns of the command `run` in SI.
export function save(file, record, names) {
  const columns = [record.times, ...names.map((name) => record.column(name))];
  const rows = Array.from(record.times, (_, i) => columns.map((column) => column[i]).join(","));
  const text = `${[["time", ...names].join(","), ...rows].join("\n")}\n`;
  const address = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
  element("a", { href: address, download: file }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}
