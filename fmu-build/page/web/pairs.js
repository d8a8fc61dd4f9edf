// Tooth pairs in the mesh of planet 1 with the left side gear, which the library lists individually.
import { shown } from "./table.js";

const TEETH = ["tooth", "solid"]; // literals of scene.gear_contact with teeth
const MOST = 3;
const at = (k, part) => `mesh.pair[${k}].${part}`;
const PLACE = ["tooth", "force", "height"];
const PRESSURES = ["toe_pressure", "middle_pressure", "heel_pressure"];
const each = Array.from({ length: MOST }, (_, k) => k + 1);

export const pairNames = (withPressures) => {
  const parts = withPressures ? [...PLACE, ...PRESSURES] : PLACE;
  return each.flatMap((k) => parts.map((part) => at(k, part)));
};

// True if gears have teeth that touch individually.
export function hasTeeth(setup, table) {
  const name = "scene.gear_contact";
  return TEETH.includes(shown(table.find(name), setup.value(name)));
}

// True if the record contains tooth pairs, and their pressures if requested.
export const hasPairs = (record, withPressures = false) => pairNames(withPressures).every((name) => record.has(name));

// Pairs in contact: [{tooth, force, height, pressures: [toe, middle, heel]}]. `value(name)` is a number of one point,
// not interpolated: between two points pairs come and go, and their positions in the list change.
export function pairs(value) {
  return each.filter((k) => value(at(k, "tooth")) >= 0 && value(at(k, "force")) !== 0).map((k) => ({
    tooth: value(at(k, "tooth")), force: value(at(k, "force")), height: value(at(k, "height")),
    pressures: PRESSURES.map((part) => value(at(k, part))),
  }));
}
