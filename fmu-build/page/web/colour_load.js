// Colours by load: meshes light up according to their force.
import { Color } from "three";
import { shown } from "./table.js";

const LIGHT = new Color("#ff5a1f");

export const label = "load";

export const needs = () => [];

export function colours({ table, most, hasPairs }) {
  const force = table.find("planet[1].left_normal_force");
  const what = hasPairs ? "each pair of planet 1 at the left by its own force" : "each mesh by its force";
  return {
    mesh: (share) => ({ share, colour: LIGHT }),
    pair: ({ force: own }) => ({ share: Math.abs(own) / most, colour: LIGHT }),
    planet: null,
    side: null,
    parts: {},
    legend: most > 0
      ? { lines: [{ text: `lit teeth: ${what}, brightest at ${shown(force, most, 3)}`, colour: LIGHT }] }
      : { lines: [{ text: "no force on the teeth" }] },
  };
}
