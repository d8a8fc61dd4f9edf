// Outputs that a run records at each point: only those for the picture, the values, the traces and the colours.
import { pairNames } from "./pairs.js";

const MOVING = ["mesh.frequency", "carrier.angle", "carrier.speed", "solver.energy_residual"];
const SIDES = ["left", "right"];

// True if a gear set of `count` planets has the variable: false for variables of further planets.
export const isThere = (name, count) => !(Number(/^planet\[(\d+)\]/.exec(name)?.[1]) > count);

export const planets = (setup) => Array.from({ length: setup.value("geometry.planet_count") }, (_, i) => `planet[${i + 1}]`);

export const forces = (setup) => planets(setup).flatMap((planet) => SIDES.map((side) => `${planet}.${side}_normal_force`));

export const heats = (table) => table.outputs().map(({ name }) => name).filter((name) => name.startsWith("heat."));

// `colours` are the outputs for the colour mode; `withPressures` adds the pressures of tooth pairs.
export function wanted(table, setup, colours, withPressures) {
  const sides = SIDES.flatMap((side) => [`${side}.angle`, `${side}.speed`, `${side}.twist`, `${side}.tangential_force`]);
  const spins = planets(setup).map((planet) => `${planet}.spin_angle`);
  const names = [...MOVING, ...sides, ...spins, ...forces(setup), ...heats(table), ...setup.shown(),
    ...pairNames(withPressures), ...colours];
  return [...new Set(names)].filter((name) => table.find(name));
}
