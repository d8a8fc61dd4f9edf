// Colours by heat: the present heating power of each cause, at its location.
import { scaled } from "./scale.js";
import { readable } from "./table.js";
import { heats } from "./wanted.js";

// Heats with a location in the picture. `meshes` are the teeth, the other names are parts of the housing.
const PLACES = {
  "heat.contact": ["meshes", "damping of teeth"], "heat.tooth_friction": ["meshes", "friction of teeth"],
  "heat.thrust": ["washers", "washers and pins"], "heat.clutch": ["clutches", "clutches and lock"],
  "heat.half_shaft": ["shafts", "half-shafts"], "heat.support": ["pins", "pins and case"],
  "heat.drag": ["case", "bearings and oil"], "heat.brake": ["brakes", "wheel brakes"],
};
const FAINT = 1e-3; // W: lower powers are not shown

export const label = "heat";

export { heats as needs };

export function colours({ table, setup, record, mostHeat }) {
  const powers = new Map();
  const lines = [];
  const off = [];
  for (const name of heats(table)) {
    const [place, words] = PLACES[name] ?? [null, name];
    const { switches } = table.find(name);
    const power = record.rate(name);
    const isOff = switches.length > 0 && !switches.some((each) => setup.value(each)) && record.largest(name) === 0;
    if (isOff) off.push(`${words} (${switches[0]})`);
    else lines.push({ words, power, place });
    if (!isOff && place) powers.set(place, (powers.get(place) ?? 0) + power);
  }
  const colour = (power) => scaled(mostHeat > 0 ? power / mostHeat : 0);
  const parts = Object.fromEntries([...powers].filter(([place]) => place !== "meshes").map(([place, power]) => [place, colour(power)]));
  const teeth = powers.get("meshes") ?? 0;
  const mesh = { share: teeth > FAINT ? 1 : 0, colour: colour(teeth) };
  return {
    // the library provides only the sum of all meshes
    mesh: (share) => (share > 0.01 ? mesh : { ...mesh, share: 0 }),
    pair: () => mesh,
    planet: null,
    side: null,
    parts,
    isGrey: true,
    legend: {
      scale: { least: "0", most: `${readable(mostHeat, 3)} W` },
      lines: lines.map(({ words, power, place }) => ({
        text: `${words} ${readable(Math.abs(power) < FAINT ? 0 : power, 3)} W`, colour: place && colour(powers.get(place)),
      })),
      off: off.length > 0 ? { text: `Off: ${off.join(", ")}` } : null,
    },
  };
}

// Largest power of a location over the record [W].
export function largestPower(record, table) {
  const places = new Map();
  for (const name of heats(table)) {
    const place = PLACES[name]?.[0] ?? name;
    places.set(place, [...(places.get(place) ?? []), record.column(name)]);
  }
  const { times } = record;
  let most = 0;
  for (const columns of places.values()) {
    for (let i = 1; i < times.length; i += 1) {
      const gained = columns.reduce((sum, column) => sum + column[i] - column[i - 1], 0);
      most = Math.max(most, gained / (times[i] - times[i - 1]));
    }
  }
  return most;
}
