// What is simulated: a scene, and what differs from it. The fragment of the page's address holds both.

const DURATION = "stop_time";
const FIRST = "study_turning";

export class Setup {
  constructor(table) {
    this.table = table;
    this.choose(FIRST);
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

  // The scene changes it over time; a value of one's own replaces that.
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

  // Outputs to draw.
  shown() {
    return this.traces ?? this.scene.outputs.slice(0, 5);
  }

  assignments(values) {
    return Object.entries(values).map(([name, value]) => this.table.assignment(name, value));
  }

  // All that differs from the start values.
  settings() {
    return this.assignments({ ...this.scene.set, ...Object.fromEntries(this.own) });
  }

  // The scene as a run takes it.
  compiled() {
    const left = (values) => Object.fromEntries(Object.entries(values).filter(([name]) => !this.own.has(name)));
    return {
      stop: this.stop,
      step: this.scene.step,
      set: this.settings(),
      changes: this.scene.changes.map(([time, values]) => [time, this.assignments(left(values))]),
      tables: this.scene.tables
        .filter(({ name }) => !this.own.has(name))
        .map(({ name, times, values, period }) => {
          return { reference: this.table.find(name).reference, table: [times, values, period] };
        }),
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
    return `#${words}`;
  }

  // Takes the set-up of a fragment; returns what it did not understand.
  read(fragment) {
    const words = new URLSearchParams(fragment.replace(/^#/, ""));
    const odd = [];
    this.choose(FIRST);
    if (this.table.scene(words.get("scene"))) this.choose(words.get("scene"));
    else if (words.has("scene")) odd.push(`scene ${words.get("scene")}`);
    for (const [name, text] of words) {
      if (name === "scene") continue;
      const known = name === "show" || (name === DURATION ? Number(text) > 0 : this.readValue(name, text));
      if (!known) odd.push(`${name}=${text}`);
    }
    if (Number(words.get(DURATION)) > 0) this.stop = Number(words.get(DURATION));
    const names = words.get("show")?.split(" ").filter((name) => this.table.find(name)?.causality === "output");
    if (names?.length > 0) this.traces = names;
    return odd;
  }

  readValue(name, text) {
    const variable = this.table.find(name);
    if (!variable || !["parameter", "input"].includes(variable.causality) || text === "") return false;
    const literal = variable.literals.find((each) => each.name === text)?.value;
    const value = variable.kind === "Boolean" ? { true: true, false: false }[text] : literal ?? Number(text);
    if (value === undefined || Number.isNaN(value)) return false;
    this.set(name, value);
    return true;
  }
}
