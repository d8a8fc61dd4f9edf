// The library in WebAssembly: an instance with the functions of FMI 2.0, surfaces of gears, and runs of scenes. Values are
// in SI.

const KINDS = ["Real", "Integer", "Boolean"];
const ERROR = 2; // fmi2Discard and worse
const CONES = ["pitch", "tip", "root", "base", "outer", "mean", "inner"]; // angles in rad, distances in mm
// parts of a message that only hosts use: the failed call before the message, and calls for recovery after it
const CALLS = /^fmi2\w+: (?:initialisation failed:\s*)?|; continue with fmi2\w+ or fmi2\w+$/g;
// numbers of a row of a schedule before those of the tables
const OWN = 6;

// Error with the library's messages about a refusal.
export class Refused extends Error {}

export class Library {
  // `module`: a WebAssembly.Module
  static async of(module) {
    return new Library((await WebAssembly.instantiate(module, {})).exports);
  }

  constructor(exports) {
    this.exports = exports;
    this.component = exports.page_instantiate();
    this.said();
    if (!this.component) throw new Refused("the library cannot create an instance");
    // also log warnings
    this.exports.fmi2SetDebugLogging(this.component, 1, 0, 0);
    this.rooms = new Map();
  }

  // Calls `use` with the address and the size of temporary memory of the library, and returns the result.
  lent(bytes, use) {
    const place = this.exports.page_allocate(bytes);
    const result = use(place, bytes);
    this.exports.page_free(place, bytes);
    return result;
  }

  // Messages since the last call: [{status, text}].
  said() {
    const text = this.lent(65536, (place, room) => {
      const length = this.exports.page_messages(place, room);
      return new TextDecoder().decode(new Uint8Array(this.exports.memory.buffer, place, length));
    });
    return text.split("\n").filter(Boolean).map((line) => ({ status: Number(line[0]), text: line.slice(2) }));
  }

  check(status, doing) {
    if (status < ERROR) return;
    const errors = this.said().filter((message) => message.status >= ERROR).map((message) => message.text.replace(CALLS, ""));
    throw new Refused(errors.join("\n") || `${doing} failed with status ${status}`);
  }

  // Writes references and values of a kind to the library's memory: [{reference, value}].
  written(kind, assignments) {
    const count = assignments.length;
    let room = this.rooms.get(kind);
    if (!room || room.count < count) {
      if (room) {
        this.exports.page_free(room.references, 4 * room.count);
        this.exports.page_free(room.values, 8 * room.count);
      }
      room = { count, references: this.exports.page_allocate(4 * count), values: this.exports.page_allocate(8 * count) };
      this.rooms.set(kind, room);
    }
    // new views each time, because the memory moves when it grows
    const { buffer } = this.exports.memory;
    const references = new Uint32Array(buffer, room.references, count);
    const values = new (kind === "Real" ? Float64Array : Int32Array)(buffer, room.values, count);
    assignments.forEach(({ reference, value }, i) => {
      references[i] = reference;
      values[i] = Number(value);
    });
    return room;
  }

  // Sets variables: [{kind, reference, value}], with one call for each kind.
  set(assignments) {
    for (const kind of KINDS) {
      const own = assignments.filter((assignment) => assignment.kind === kind);
      if (own.length === 0) continue;
      const { references, values } = this.written(kind, own);
      this.check(this.exports[`fmi2Set${kind}`](this.component, references, own.length, values), `setting ${kind}`);
    }
  }

  // Sets the slopes of inputs per second: [{reference, value}].
  setSlopes(slopes) {
    const count = slopes.length;
    const { references, values } = this.written("Real", slopes);
    const status = this.lent(4 * count, (orders) => {
      new Int32Array(this.exports.memory.buffer, orders, count).fill(1);
      return this.exports.fmi2SetRealInputDerivatives(this.component, references, count, orders, values);
    });
    this.check(status, "setting slopes of inputs");
  }

  // Creates a function that reads these Reals into an array from a position on. It writes references only once and
  // allocates nothing.
  reader(references) {
    const count = references.length;
    const [from, to] = [this.exports.page_allocate(4 * count), this.exports.page_allocate(8 * count)];
    new Uint32Array(this.exports.memory.buffer, from, count).set(references);
    let values = new Float64Array(this.exports.memory.buffer, to, count);
    const read = (target, place) => {
      this.check(this.exports.fmi2GetReal(this.component, from, count, to), "reading");
      // the memory moves when it grows
      if (values.length === 0) values = new Float64Array(this.exports.memory.buffer, to, count);
      target.set(values, place);
    };
    const free = () => {
      this.exports.page_free(from, 4 * count);
      this.exports.page_free(to, 8 * count);
    };
    return { count, read, free };
  }

  // Restarts with these assignments, for a run to `stop`.
  start(assignments, stop) {
    this.check(this.exports.fmi2Reset(this.component), "fmi2Reset");
    this.said();
    this.check(this.exports.fmi2SetupExperiment(this.component, 0, 0, 0, 1, stop), "fmi2SetupExperiment");
    this.set(assignments);
    this.check(this.exports.fmi2EnterInitializationMode(this.component), "fmi2EnterInitializationMode");
    this.check(this.exports.fmi2ExitInitializationMode(this.component), "fmi2ExitInitializationMode");
  }

  // Rows of a run's schedule with `width` numbers each; bd_answers.h describes question and rows.
  schedule(question, width) {
    const rows = this.lent(8 * question.length, (from) => {
      new Float64Array(this.exports.memory.buffer, from, question.length).set(question);
      const count = Math.max(this.exports.bd_schedule(from, question.length, from, 0), 0) * width;
      return this.lent(8 * count, (to) => {
        this.exports.bd_schedule(from, question.length, to, count);
        return new Float64Array(this.exports.memory.buffer, to, count).slice();
      });
    });
    if (rows.length === 0) throw new Refused("This run has more than 1e8 steps or jumps of inputs; end it earlier.");
    return rows;
  }

  step(time, size) {
    this.check(this.exports.fmi2DoStep(this.component, time, size, 1), `the step from ${time} s`);
  }

  // Surface of a gear (0 planet, 1 side gear) for assignments of all kinds, in mm; null if it cannot be built.
  gear(assignments, gear) {
    const surface = this.lent(16 * Math.max(assignments.length, 1), (place) => {
      const view = new DataView(this.exports.memory.buffer);
      assignments.forEach(({ reference, value }, i) => {
        view.setUint32(place + 16 * i, reference, true);
        view.setFloat64(place + 16 * i + 8, Number(value), true);
      });
      return this.exports.page_gear(place, assignments.length, gear);
    });
    if (!surface) return null;
    const numbers = (kind, array) => this.lent(4, (count) => {
      const first = this.exports.page_gear_numbers(surface, kind, count);
      const { buffer } = this.exports.memory;
      return new array(buffer, first, new Uint32Array(buffer, count, 1)[0]).slice();
    });
    const cones = numbers(2, Float64Array);
    const made = {
      vertices: numbers(0, Float32Array), triangles: numbers(1, Uint32Array),
      cones: Object.fromEntries(CONES.map((name, i) => [name, cones[i]])),
    };
    this.exports.page_gear_free(surface);
    return made;
  }
}

// Run of a scene, row by row of its record: it executes the schedule that the library computes.
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
    return points === 0 ? [] : [`the run ends a step at each of ${points} points of tables between its communication points, `
      + "which makes it much longer; tables with fewer points make it shorter"];
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
