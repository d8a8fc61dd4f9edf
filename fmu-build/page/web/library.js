// The library in WebAssembly: an instance with the functions of FMI 2.0, and surfaces of gears. Values are in SI.

const BYTES = { Real: 8, Integer: 4, Boolean: 4 };
const ERROR = 2; // fmi2Discard and worse
const CONES = ["pitch", "tip", "root", "base", "outer", "mean", "inner"]; // angles in rad, distances in mm
// parts of a message that only hosts use: the failed call before the message, and calls for recovery after it
const CALLS = /^fmi2\w+: (?:initialisation failed:\s*)?|; continue with fmi2\w+ or fmi2\w+$/g;

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

  // Messages since the last call: [{status, text}].
  said() {
    const room = 65536;
    const place = this.exports.page_allocate(room);
    const length = this.exports.page_messages(place, room);
    const text = new TextDecoder().decode(new Uint8Array(this.exports.memory.buffer, place, length));
    this.exports.page_free(place, room);
    return text.split("\n").filter(Boolean).map((line) => ({ status: Number(line[0]), text: line.slice(2) }));
  }

  check(status, doing) {
    if (status < ERROR) return;
    const errors = this.said().filter((message) => message.status >= ERROR).map((message) => message.text.replace(CALLS, ""));
    throw new Refused(errors.join("\n") || `${doing} failed with status ${status}`);
  }

  // Room for `count` numbers and references of a kind in the library's memory.
  room(kind, count) {
    const known = this.rooms.get(kind);
    if (known && known.count >= count) return known;
    if (known) {
      this.exports.page_free(known.references, 4 * known.count);
      this.exports.page_free(known.values, 8 * known.count);
    }
    const made = { count, references: this.exports.page_allocate(4 * count), values: this.exports.page_allocate(8 * count) };
    this.rooms.set(kind, made);
    return made;
  }

  views(kind, room, count) {
    // new views each time, because the memory moves when it grows
    const { buffer } = this.exports.memory;
    const values = kind === "Real" ? new Float64Array(buffer, room.values, count) : new Int32Array(buffer, room.values, count);
    return { references: new Uint32Array(buffer, room.references, count), values };
  }

  // Sets variables: [{kind, reference, value}], with one call for each kind.
  set(assignments) {
    for (const kind of Object.keys(BYTES)) {
      const own = assignments.filter((assignment) => assignment.kind === kind);
      if (own.length === 0) continue;
      const room = this.room(kind, own.length);
      const { references, values } = this.views(kind, room, own.length);
      own.forEach((assignment, i) => {
        references[i] = assignment.reference;
        values[i] = Number(assignment.value);
      });
      this.check(this.exports[`fmi2Set${kind}`](this.component, room.references, own.length, room.values), `setting ${kind}`);
    }
  }

  // Sets the slopes of inputs per second: [{reference, value}].
  setSlopes(slopes) {
    const count = slopes.length;
    const room = this.room("Real", count);
    const orders = this.exports.page_allocate(4 * count);
    const { references, values } = this.views("Real", room, count);
    new Int32Array(this.exports.memory.buffer, orders, count).fill(1);
    slopes.forEach(({ reference, value }, i) => {
      references[i] = reference;
      values[i] = value;
    });
    const status = this.exports.fmi2SetRealInputDerivatives(this.component, room.references, count, orders, room.values);
    this.exports.page_free(orders, 4 * count);
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
    const from = this.exports.page_allocate(8 * question.length);
    new Float64Array(this.exports.memory.buffer, from, question.length).set(question);
    const count = this.exports.bd_schedule(from, question.length, from, 0);
    const room = Math.max(count, 0) * width;
    const to = this.exports.page_allocate(8 * room);
    this.exports.bd_schedule(from, question.length, to, room);
    const rows = new Float64Array(this.exports.memory.buffer, to, room).slice();
    this.exports.page_free(from, 8 * question.length);
    this.exports.page_free(to, 8 * room);
    if (count < 1) throw new Refused("This run has more than 1e8 steps or jumps of inputs; end it earlier.");
    return rows;
  }

  step(time, size) {
    this.check(this.exports.fmi2DoStep(this.component, time, size, 1), `the step from ${time} s`);
  }

  // Surface of a gear (0 planet, 1 side gear) for assignments of all kinds, in mm; null if it cannot be built.
  gear(assignments, gear) {
    const bytes = 16 * Math.max(assignments.length, 1);
    const place = this.exports.page_allocate(bytes);
    const view = new DataView(this.exports.memory.buffer);
    assignments.forEach(({ reference, value }, i) => {
      view.setUint32(place + 16 * i, reference, true);
      view.setFloat64(place + 16 * i + 8, Number(value), true);
    });
    const surface = this.exports.page_gear(place, assignments.length, gear);
    this.exports.page_free(place, bytes);
    if (!surface) return null;
    const numbers = (kind, array) => {
      const count = this.exports.page_allocate(4);
      const first = this.exports.page_gear_numbers(surface, kind, count);
      const { buffer } = this.exports.memory;
      const copy = new array(buffer, first, new Uint32Array(buffer, count, 1)[0]).slice();
      this.exports.page_free(count, 4);
      return copy;
    };
    const cones = numbers(2, Float64Array);
    const made = {
      vertices: numbers(0, Float32Array), triangles: numbers(1, Uint32Array),
      cones: Object.fromEntries(CONES.map((name, i) => [name, cones[i]])),
    };
    this.exports.page_gear_free(surface);
    return made;
  }
}
