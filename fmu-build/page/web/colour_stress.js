// Colour by stress: gears by the stress at their roots, flanks in contact by their pressure, each against its strength.
import { scaled } from "./scale.js";
import { readable, shown } from "./table.js";

const SWITCH = "effects.strength";
const ROOTS = { planet: "stress.root_planet_max", side: "stress.root_side_max" };
const CONTACT = "stress.contact_max";
const SAFETY = ["safety.root_min", "safety.flank_min"];

export const label = "stress";
export const withPressures = true;

export const needs = () => [...Object.values(ROOTS), CONTACT, ...SAFETY];

export function colours({ table, setup, record }) {
  const none = { share: 0, colour: scaled(0) };
  const plain = { mesh: () => none, pair: () => none, planet: null, side: null, parts: {} };
  if (!setup.value(SWITCH)) {
    return { ...plain, legend: { lines: [], off: { text: "Stresses come with", name: SWITCH } } };
  }
  const [bending, contact] = ["bending_strength", "contact_strength"].map((name) => setup.value(`strength.${name}`));
  const root = (gear) => record.value(ROOTS[gear]) / bending;
  const pressure = record.value(CONTACT);
  const line = (text, name, strength) => ({
    text: `${text} ${shown(table.find(name), record.value(name), 3)} of ${shown(table.find(name), strength, 3)}`,
    colour: scaled(record.value(name) / strength),
  });
  const [rootSafety, flankSafety] = SAFETY.map((name) => record.value(name));
  return {
    // the library gives the largest of all pairs; pairs of planet 1 at the left have their own
    mesh: (share) => (share > 0.01 ? { share: 1, colour: scaled(pressure / contact) } : none),
    pair: ({ pressures }) => ({ share: 1, colour: scaled(Math.max(...pressures) / contact) }),
    planet: scaled(root("planet")),
    side: scaled(root("side")),
    parts: {},
    legend: {
      scale: { least: "0", most: "strength" },
      lines: [
        line("roots of planets, largest:", ROOTS.planet, bending),
        line("roots of side gears, largest:", ROOTS.side, bending),
        line("flanks in contact, largest:", CONTACT, contact),
        { text: `smallest safety so far: roots ${readable(rootSafety, 3)}, flanks ${readable(flankSafety, 3)}` },
      ],
    },
  };
}
