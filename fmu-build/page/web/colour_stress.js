// Colours by stress: gears by the stress at their roots, flanks in contact by their rated pressure. Each is relative to
// the limit of its rating.
import { rolls } from "./rolling.js";
import { scaled } from "./scale.js";
import { readable, shown } from "./table.js";

const SWITCH = "effects.strength";
const ROOTS = { planet: "stress.root_planet_max", side: "stress.root_side_max" };
const CONTACT = "stress.contact_rated";
const SAFETY = ["safety.root_min", "safety.flank_min"];

export const label = "stress";

export const needs = () => [...Object.values(ROOTS), CONTACT, ...SAFETY];

// Strengths for the present rating of stresses [Pa]. Teeth of rolling planets are loaded on both flanks.
export function limits(setup, record) {
  const [bending, contact, idler] = ["bending_strength", "contact_strength", "idler_factor"].map((name) => setup.value(`strength.${name}`));
  const isRolling = rolls(record, setup.value("geometry.planet_count"), Math.PI / setup.value("geometry.planet_teeth"));
  return { planet: isRolling ? idler * bending : bending, side: bending, contact };
}

export function colours({ table, setup, record }) {
  const none = { share: 0, colour: scaled(0) };
  const plain = { mesh: () => none, pair: () => none, planet: null, side: null, parts: {} };
  if (!setup.value(SWITCH)) {
    return { ...plain, legend: { lines: [], off: { text: "Stresses come with", name: SWITCH } } };
  }
  const strength = limits(setup, record);
  const share = (name, limit) => record.value(name) / limit;
  const line = (text, name, limit) => ({
    text: `${text} ${shown(table.find(name), record.value(name), 3)} of ${shown(table.find(name), limit, 3)}`,
    colour: scaled(share(name, limit)),
  });
  const [rootSafety, flankSafety] = SAFETY.map((name) => record.value(name));
  // the library rates the most loaded mesh
  const flanks = { share: 1, colour: scaled(share(CONTACT, strength.contact)) };
  return {
    mesh: (load) => (load > 0.01 ? flanks : none),
    pair: () => flanks,
    planet: scaled(share(ROOTS.planet, strength.planet)),
    side: scaled(share(ROOTS.side, strength.side)),
    parts: {},
    legend: {
      scale: { least: "0", most: "strength" },
      lines: [
        line("roots of planets, largest:", ROOTS.planet, strength.planet),
        line("roots of side gears, largest:", ROOTS.side, strength.side),
        line("flanks, rated pressure:", CONTACT, strength.contact),
        { text: `smallest safety so far: roots ${readable(rootSafety, 3)}, flanks ${readable(flankSafety, 3)}` },
      ],
    },
  };
}
