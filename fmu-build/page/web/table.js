// Table of variables, and their values as text. Names, units, ranges and start values come from the library's model
// description.

const NAMES = /[\w.[\]]+(?=:)/g;
const SPECIAL = { nan: NaN, inf: Infinity, infinity: Infinity, "-inf": -Infinity, "-infinity": -Infinity };
const NUMBER = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;
const INTEGERS = [-(2 ** 31), 2 ** 31 - 1];

export const FORCE = "N"; // unit of forces

// Units for displayed speeds, with their values for 1 rad/s.
export const SPEEDS = { "deg/s": 180 / Math.PI, "rad/s": 1, rpm: 30 / Math.PI };

export class Table {
  constructor({ variables, scenes, prices }) {
    Object.assign(this, { variables, scenes });
    this.byName = new Map(variables.map((variable) => [variable.name, variable]));
    this.prices = new Map(prices.map(({ effect, factor }) => [effect, factor]));
  }

  find(name) {
    return this.byName.get(name);
  }

  // SI value as text with the displayed unit of a variable.
  shown(name, value, digits) {
    return shown(this.find(name), value, digits);
  }

  // Changes the displayed unit of speeds.
  showSpeedsIn(unit) {
    const speeds = this.variables.filter((variable) => variable.unit === "rad/s");
    for (const variable of speeds) Object.assign(variable, { shown: unit, factor: SPEEDS[unit] });
  }

  scene(name) {
    return this.scenes.find((scene) => scene.name === name);
  }

  // Variables that a reader may set, grouped by the part of the name before the dot.
  groups() {
    return grouped(this.variables.filter(isSettable), ({ name }) => name.split(".")[0]);
  }

  // Outputs that can be drawn over time.
  outputs() {
    return this.variables.filter(({ causality, kind }) => causality === "output" && kind === "Real");
  }

  // Assignment for the functions of FMI.
  assignment(name, value) {
    const { kind, reference } = this.find(name);
    return { kind: kind === "Enumeration" ? "Integer" : kind, reference, value };
  }

  // Finds the variable in a message: {name, text} with the text from the variable's name on; name is null if there is
  // none.
  subject(message) {
    const found = [...message.matchAll(NAMES)].find(([name]) => this.byName.has(name));
    return found ? { name: found[0], text: message.slice(found.index) } : { name: null, text: message };
  }
}

// True for the variables that a reader may set.
export const isSettable = ({ causality }) => ["parameter", "input"].includes(causality);

// Map of lists of items by key.
export function grouped(items, keyOf) {
  const groups = new Map();
  for (const item of items) groups.set(keyOf(item), [...(groups.get(keyOf(item)) ?? []), item]);
  return groups;
}

export const clamp = (value, least, most) => Math.min(Math.max(value, least), most);

// Formats a number for readers: `digits` significant digits, a real minus sign, and an exponent only if necessary.
export function readable(value, digits = 5) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  const isPlain = size === 0 || (size < 1e7 && size >= 1e-4);
  const text = isPlain ? String(Number(value.toPrecision(digits))) : value.toExponential(digits - 1);
  return text.replace(/\.?0+e/, "e").replace("e+", "e").replaceAll("-", "−");
}

// Name of a variable as words.
export const words = (name) => name.replaceAll("]", "").replaceAll(/[[._]/g, " ");

// Unit of forces up to a largest one [N], as {name, factor}: kN from 1 kN on.
export const forceUnit = (largest) => (Math.abs(largest) < 1e3 ? { name: FORCE, factor: 1 } : { name: `k${FORCE}`, factor: 1e-3 });

// Force [N] as text, in the unit of a largest force.
export function forceText(force, digits = 3, largest = force) {
  const { name, factor } = forceUnit(largest);
  return `${readable(factor * force, digits)} ${name}`;
}

// Unit for readers.
export function unitText(unit) {
  if (!unit || unit === "1") return "";
  const read = unit.replaceAll("deg", "°").replaceAll(".", "·").replace("^1·5", "^1.5").replace("um", "µm");
  return read.replace(/([a-z)])2/g, "$1²");
}

// Conversion of an SI value to the variable's displayed unit.
export const inUnit = ({ factor, offset }, value) => factor * value + offset;

function shown(variable, value, digits = 5) {
  if (variable.kind === "Boolean") return value ? "on" : "off";
  if (variable.kind === "Enumeration") return variable.literals.find((literal) => literal.value === value)?.name ?? "?";
  const unit = unitText(variable.shown);
  return `${readable(inUnit(variable, value), digits)}${unit && ` ${unit}`}`;
}

// Range of a variable with its displayed unit; empty if it accepts any number.
export function range(variable) {
  if (variable.min === null) return "";
  const end = (value) => readable(inUnit(variable, value), 4);
  return `${end(variable.min)} to ${shown({ ...variable, kind: "Real" }, variable.max, 4)}`;
}

// Parses a text in the variable's displayed unit, from a field or the address. Returns {value} in SI or {fault}. Numbers
// of the right kind are left to the library, including NaN and values out of range, because its messages are better than
// a second list of rules.
export function readValue(variable, text) {
  const { name, kind, literals, factor, offset } = variable;
  const plain = text.trim().replace("−", "-").replace(",", ".");
  if (kind === "Boolean") {
    if (plain === "true" || plain === "false") return { value: plain === "true" };
    return { fault: `${name}: “${text}” is neither true nor false` };
  }
  if (kind === "Enumeration") {
    const literal = literals.find((each) => each.name === plain || String(each.value) === plain);
    if (literal) return { value: literal.value };
    return { fault: `${name}: “${text}” is not one of ${literals.map((each) => each.name).join(", ")}` };
  }
  const number = NUMBER.test(plain) ? Number(plain) : SPECIAL[plain.toLowerCase()];
  const unit = unitText(variable.shown);
  const sort = kind === "Integer" ? "a whole number" : `a number${unit && ` in ${unit}`}`;
  const takes = `it takes ${sort}${range(variable) && `, ${range(variable)}`}`;
  if (number === undefined) return { fault: `${name}: “${text}” is not a number; ${takes}` };
  if (kind === "Integer" && !(Number.isInteger(number) && number >= INTEGERS[0] && number <= INTEGERS[1])) {
    return { fault: `${name}: ${text} is not a whole number of 32 bits; ${takes}` };
  }
  return { value: (number - offset) / factor };
}

// Parses a text in SI, as in a link.
export const readValueInSI = (variable, text) => readValue({ ...variable, shown: variable.unit ?? "1", factor: 1, offset: 0 }, text);
