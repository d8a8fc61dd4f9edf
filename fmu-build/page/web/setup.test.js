// Every parameter and input can be set in the page and is restored by the link: npm test, with the page's data.json as
// DATA.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { Setup } from "./setup.js";
import { inUnit, readValue, readValueInSI, Table } from "./table.js";

const table = new Table(JSON.parse(readFileSync(process.env.DATA, "utf8")));
const settable = table.variables.filter(({ causality }) => ["parameter", "input"].includes(causality));

// Returns a value of the variable that differs from the scene.
function other({ kind, start, min, max, literals }) {
  if (kind === "Boolean") return !start;
  if (kind === "Enumeration") return literals.find(({ value }) => value !== start)?.value ?? start;
  if (kind === "Integer") return start === max ? min : start + 1;
  const value = min === null ? start + 1 / 3 : min + (max - min) / 3;
  return value === start ? min + (max - min) / 7 : value;
}

test("the link restores every parameter and input to the last bit", () => {
  assert.ok(settable.length > 100);
  for (const variable of settable) {
    const [here, there] = [new Setup(table), new Setup(table)];
    const value = other(variable);
    here.set(variable.name, value);
    const { odd, faults } = there.read(here.fragment());
    assert.deepEqual([odd, faults], [[], []], variable.name);
    assert.equal(there.value(variable.name), value, variable.name);
    assert.deepEqual(there.compiled(), here.compiled(), variable.name);
  }
});

test("the link restores all of them together, with view, colours, traces and duration", () => {
  const [here, there] = [new Setup(table), new Setup(table)];
  here.choose("clunk");
  for (const variable of settable) here.set(variable.name, other(variable));
  Object.assign(here, { view: "flank", colour: "stress", traces: ["left.speed", "planet[1].left_normal_force"] });
  assert.equal(here.setStop(0.125), null);
  assert.deepEqual(there.read(here.fragment()), { odd: [], faults: [] });
  assert.equal(there.fragment(), here.fragment());
  assert.deepEqual(there.compiled(), here.compiled());
});

test("invalid values are left out with a message that names the variable, and unknown words are named", () => {
  const setup = new Setup(table);
  const { odd, faults } = setup.read("#scene=nowhere&geometry.module=big&effects.strength=perhaps&geometry.planet_teeth=9.5"
    + "&scene.gear_contact=glue&view=inside&constructor=1&stop_time=Infinity&left.speed=3&show=nothing");
  assert.deepEqual(odd, ["scene=nowhere", "view=inside", "constructor=1", "stop_time=Infinity", "left.speed=3", "show=nothing"]);
  const names = ["geometry.module", "effects.strength", "geometry.planet_teeth", "scene.gear_contact"];
  assert.deepEqual(faults.map(({ name }) => name), names);
  for (const { name, text } of faults) assert.ok(text.startsWith(`${name}: “`) || text.startsWith(`${name}: 9.5`), text);
  for (const name of names) assert.ok(!setup.isOwn(name));
});

test("NaN and numbers out of range are left to the library", () => {
  const module = table.find("geometry.module");
  assert.ok(Number.isNaN(readValueInSI(module, "NaN").value));
  assert.equal(readValue(module, "-1e3").value, -1e3 / module.factor);
  assert.equal(readValue(table.find("geometry.planet_teeth"), "4294967306").fault.includes("32 bits"), true);
});

test("temperatures are shown and read in °C", () => {
  const temperature = table.find("oil.temperature");
  assert.ok(Math.abs(readValue(temperature, "60").value - 333.15) < 1e-12);
  assert.ok(Math.abs(inUnit(temperature, 333.15) - 60) < 1e-12);
  assert.equal(readValueInSI(temperature, "333.15").value, 333.15);
});
