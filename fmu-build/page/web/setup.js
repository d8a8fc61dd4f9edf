// The simulated set-up and its display: a scene, changed values, view and colours. The fragment of the page's address
// contains all of it.
import { MODES } from "./colouring.js";
import { isSettable, readable, readValueInSI, SPEEDS } from "./table.js";
import { PRESETS } from "./view.js";

const DURATION = "stop_time";
const FIRST = "study_turning";
const MOST_POINTS = 2e5; // maximum number of points of a run
export const MOST_TRACES = 6; // number of trace colours
// words of the address other than variables, with their defaults
const PLAIN = { view: "whole", colour: "load", speeds: "deg/s", picture: "auto" };
const KNOWN = { view: PRESETS, colour: MODES, speeds: SPEEDS, picture: { auto: true, fine: true } };

export class Setup {
  constructor(table) {
    this.table = table;
    this.choose(FIRST);
    Object.assign(this, PLAIN);
  }

  choose(name) {
    this.scene = this.table.scene(name);
    this.own = new Map();
    this.stop = this.scene.stop;
    this.traces = null;
  }

  valueInScene(name) {
    return this.scene.set[name] ?? this.table.find(name).start;
  }

  value(name) {
    return this.own.get(name) ?? this.valueInScene(name);
  }

  // True if the scene changes the variable over time; a changed value of the set-up replaces that.
  isDriven(name) {
    return this.scene.tables.some((table) => table.name === name) || this.scene.changes.some(([, values]) => name in values);
  }

  isOwn(name) {
    return this.own.has(name);
  }

  set(name, value) {
    if (value === this.valueInScene(name) && !this.isDriven(name)) this.own.delete(name);
    else this.own.set(name, value);
  }

  reset(name) {
    this.own.delete(name);
  }

  // Sets the duration [s]; returns a message if it is not allowed.
  setStop(stop) {
    const longest = MOST_POINTS * this.scene.step;
    if (!(stop > 0 && stop <= longest)) return `The duration takes a time above 0 s, up to ${readable(longest)} s in this scene.`;
    this.stop = stop;
    return null;
  }

  // Outputs to draw.
  shown() {
    return this.traces ?? this.scene.outputs.slice(0, 5);
  }

  assignments(values) {
    return Object.entries(values).map(([name, value]) => this.table.assignment(name, value));
  }

  // All values that differ from the start values.
  settings() {
    return this.assignments({ ...this.scene.set, ...Object.fromEntries(this.own) });
  }

  // The scene in the form that a run needs.
  compiled() {
    const left = (values) => Object.fromEntries(Object.entries(values).filter(([name]) => !this.own.has(name)));
    return {
      stop: this.stop,
      step: this.scene.step,
      set: this.settings(),
      changes: this.scene.changes.map(([time, values]) => [time, this.assignments(left(values))]),
      tables: this.scene.tables.filter(({ name }) => !this.own.has(name)).map(({ name, times, values, period }) => (
        { reference: this.table.find(name).reference, table: [times, values, period] })),
      slopes: this.scene.slopes,
    };
  }

  fragment() {
    const words = new URLSearchParams({ scene: this.scene.name });
    if (this.stop !== this.scene.stop) words.set(DURATION, this.stop);
    for (const [name, value] of this.own) {
      const literal = this.table.find(name).literals.find((each) => each.value === value);
      words.set(name, literal ? literal.name : String(value));
    }
    if (this.traces) words.set("show", this.traces.join(" "));
    return this.withLook(words);
  }

  // Fragment for an unchanged scene in the present view.
  fragmentOf(scene) {
    return this.withLook(new URLSearchParams({ scene }));
  }

  withLook(words) {
    for (const [word, plain] of Object.entries(PLAIN)) if (this[word] !== plain) words.set(word, this[word]);
    return `#${words}`;
  }

  // Reads the set-up from a fragment. Returns {odd, faults}: unknown words, and [{name, text}] for variables with
  // invalid values.
  read(fragment) {
    const words = new URLSearchParams(fragment.replace(/^#/, ""));
    const [odd, faults] = [[], []];
    this.choose(this.table.scene(words.get("scene")) ? words.get("scene") : FIRST);
    Object.assign(this, PLAIN);
    for (const [word, text] of words) if (!this.take(word, text, faults)) odd.push(`${word}=${text}`);
    return { odd, faults };
  }

  // True if the word of the address is known.
  take(word, text, faults) {
    if (word === "scene") return this.scene.name === text;
    if (word === DURATION) return this.setStop(Number(text)) === null;
    if (word in KNOWN) {
      if (!Object.hasOwn(KNOWN[word], text)) return false;
      this[word] = text;
      return true;
    }
    if (word === "show") {
      const isOutput = (name) => this.table.find(name)?.causality === "output";
      const names = text.split(" ").filter(Boolean);
      if (names.some(isOutput)) this.traces = [...new Set(names.filter(isOutput))].slice(0, MOST_TRACES);
      return names.length > 0 && names.every(isOutput);
    }
    const variable = this.table.find(word);
    if (!variable || !isSettable(variable)) return false;
    const { value, fault } = readValueInSI(variable, text);
    if (fault) faults.push({ name: word, text: fault });
    else this.set(word, value);
    return true;
  }
}
