// Parses a value from a field or the address. Numbers of the right kind are left to the library, including NaN and
// values out of range, because its messages are better than a second list of rules.
import { inSI, range, unitText } from "./table.js";

const SPECIAL = { nan: NaN, inf: Infinity, infinity: Infinity, "-inf": -Infinity, "-infinity": -Infinity };
const NUMBER = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;
const INTEGERS = [-(2 ** 31), 2 ** 31 - 1];

// Returns {value} in SI or {fault}, from a text in the variable's displayed unit.
export function readValue(variable, text) {
  const { name, kind, literals } = variable;
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
  const inUnit = unitText(variable.shown) && ` in ${unitText(variable.shown)}`;
  const takes = `it takes ${kind === "Integer" ? "a whole number" : `a number${inUnit}`}${range(variable) && `, ${range(variable)}`}`;
  if (number === undefined) return { fault: `${name}: “${text}” is not a number; ${takes}` };
  if (kind === "Integer" && !(Number.isInteger(number) && number >= INTEGERS[0] && number <= INTEGERS[1])) {
    return { fault: `${name}: ${text} is not a whole number of 32 bits; ${takes}` };
  }
  return { value: inSI(variable, number) };
}

// Parses a text in SI, as in a link.
export const readValueInSI = (variable, text) => readValue({ ...variable, shown: variable.unit ?? "1", factor: 1, offset: 0 }, text);
