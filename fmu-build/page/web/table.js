// Table of variables: names, units, ranges and start values come from the library's model description.

const NAMES = /[\w.[\]]+(?=:)/g;

// Units for displayed speeds, with their values for 1 rad/s.
export const SPEEDS = { "deg/s": 180 / Math.PI, "rad/s": 1, rpm: 30 / Math.PI };

export class Table {
  constructor({ variables, scenes, prices, version }) {
    Object.assign(this, { variables, scenes, version });
    this.byName = new Map(variables.map((variable) => [variable.name, variable]));
    this.prices = new Map(prices.map(({ effect, factor }) => [effect, factor]));
  }

  find(name) {
    return this.byName.get(name);
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
    const groups = new Map();
    for (const variable of this.variables) {
      if (variable.causality !== "parameter" && variable.causality !== "input") continue;
      const group = variable.name.split(".")[0];
      if (!groups.has(group)) groups.set(group, []);
      groups.get(group).push(variable);
    }
    return groups;
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

// Unit for readers.
export function unitText(unit) {
  if (!unit || unit === "1") return "";
  const read = unit.replaceAll("deg", "°").replaceAll(".", "·").replace("^1·5", "^1.5").replace("um", "µm");
  return read.replace(/([a-z)])2/g, "$1²");
}

// Conversion of an SI value to the variable's displayed unit, and back.
export const inUnit = ({ factor, offset }, value) => factor * value + offset;
export const inSI = ({ factor, offset }, number) => (number - offset) / factor;

// SI value as text with its displayed unit.
export function shown(variable, value, digits = 5) {
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
