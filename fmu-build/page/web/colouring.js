// Meaning of the picture's colours: load, stress or heat, with a common colour scale and a legend.
import { Color } from "three";
import { element } from "./frame.js";
import { hasPacks, litPlates } from "./half_shafts.js";
import { heats, planetNames } from "./record.js";
import { clamp, forceText, grouped, readable } from "./table.js";

// from dark blue through green to red; in greyscale the order is preserved, except for the last step
const STOPS = ["#2b4f9e", "#2a8fb0", "#3fae6b", "#d9c431", "#ee7b22", "#d3202a"].map((colour) => new Color(colour));

// light of loaded teeth
const LIGHT = new Color("#ff5a1f");
const DARK = { share: 0, colour: LIGHT };

const STRENGTH = "effects.strength";
const ROOTS = { planet: "stress.root_planet_max", side: "stress.root_side_max" };
const RATED = "stress.contact_rated";
const SAFETY = ["safety.root_min", "safety.flank_min"];

// Heats with a location in the picture. `meshes` are the teeth, the other names are parts of the housing or of the final
// drive.
const PLACES = {
  "heat.contact": ["meshes", "damping of teeth"], "heat.tooth_friction": ["meshes", "friction of teeth"],
  "heat.thrust": ["washers", "washers and pins"], "heat.clutch": ["clutches", "clutches and lock"],
  "heat.half_shaft": ["shafts", "half-shafts"], "heat.support": ["pins", "pins and case"],
  "heat.drag": ["case", "bearings and oil"], "heat.brake": ["brakes", "wheel brakes"],
  "heat.clutch_command": ["plates", "clutches on command"], "heat.disconnect": ["dogs", "dog clutches"],
  "heat.final_drive": ["drive", "final drive"], "heat.propeller_shaft": ["propeller", "propeller shaft"],
};
const FAINT = 1e-3; // W: lower powers are not shown

// A mode lists the outputs that it `needs`, in addition to those of every run. For the time of the last call of
// `record.seek`, `colours` returns which parts are lit or coloured. All other parts are plain metal.
//   mesh(share)  light of a mesh with this share of the largest force: {share, colour}, share 0 for none
//   pair(pair)   light of a tooth pair of planet 1 with the left side gear
//   planet, side colours of the gears, if they have any
//   parts        colours of washers, clutches, pins, shafts, dog clutches, case, brakes, final drive, propeller shaft by name
//   plates       light of the clutches on command by side: {side: {share, colour}}, if they have any
//   isGrey       true if gears without a colour are grey
//   legend       {lines: [{text, colour}], scale: {least, most} or none, off: {text, name} or none}
export const MODES = {
  load: { needs: [], colours: byLoad },
  stress: { needs: [...Object.values(ROOTS), RATED, ...SAFETY], colours: byStress },
  heat: { needs: [], colours: byHeat },
};

// Colour of a fraction from 0 to 1. Larger values have the last colour. NaN has the first one: it is a fraction of a
// largest value that is not known yet.
export function scaled(share) {
  const place = within(share) * (STOPS.length - 1);
  const below = Math.min(Math.floor(place), STOPS.length - 2);
  return STOPS[below].clone().lerp(STOPS[below + 1], place - below);
}

const within = (share) => clamp(share || 0, 0, 1);

const css = (colour) => `#${colour.getHexString()}`;

// The colour as text for a canvas, from a palette because a canvas needs many.
const palette = Array.from({ length: 256 }, (_, k) => css(scaled(k / 255)));
export const shade = (share) => palette[Math.round(255 * within(share))];

export const gradient = () => `linear-gradient(to right, ${STOPS.map(css).join(", ")})`;

// Meshes light up according to their force.
function byLoad({ setup, record, most, hasPairs }) {
  const what = hasPairs ? "each pair of planet 1 at the left by its own force" : "each mesh by its force";
  const line = most > 0
    ? { text: `lit teeth: ${what}, brightest at ${forceText(most)}`, colour: LIGHT }
    : { text: "no force on the teeth" };
  return {
    mesh: (share) => ({ share, colour: LIGHT }),
    pair: ({ force }) => ({ share: Math.abs(force) / most, colour: LIGHT }),
    parts: {},
    plates: litPlates({ setup, record }, LIGHT),
    legend: { lines: [line, ...(hasPacks(setup) ? [plateLine(setup)] : [])] },
  };
}

// Line of the legend about clutches on command.
const plateLine = (setup) => {
  const full = setup.table.shown("clutches.torque", setup.value("clutches.torque"), 3);
  return { text: `lit plates: torque of a clutch on command, brightest at ${full}`, colour: LIGHT };
};

// Gears are coloured by the stress at their roots, flanks in contact by their rated pressure. Each is relative to the
// limit of its rating.
function byStress({ setup, record }) {
  if (!setup.value(STRENGTH)) {
    const legend = { lines: [], off: { text: "Stresses come with", name: STRENGTH } };
    return { mesh: () => DARK, pair: () => DARK, parts: {}, legend };
  }
  const strength = limits(setup, record);
  const colour = (name, limit) => scaled(record.value(name) / limit);
  const line = (text, name, limit) => ({
    text: `${text} ${setup.table.shown(name, record.value(name), 3)} of ${setup.table.shown(name, limit, 3)}`,
    colour: colour(name, limit),
  });
  const [rootSafety, flankSafety] = SAFETY.map((name) => readable(record.value(name), 3));
  // the library rates the most loaded mesh
  const flanks = { share: 1, colour: colour(RATED, strength.contact) };
  return {
    mesh: (load) => (load > 0.01 ? flanks : DARK),
    pair: () => flanks,
    planet: colour(ROOTS.planet, strength.planet),
    side: colour(ROOTS.side, strength.side),
    parts: {},
    legend: {
      scale: { least: "0", most: "strength" },
      lines: [
        line("roots of planets, largest:", ROOTS.planet, strength.planet),
        line("roots of side gears, largest:", ROOTS.side, strength.side),
        line("flanks, rated pressure:", RATED, strength.contact),
        { text: `smallest safety so far: roots ${rootSafety}, flanks ${flankSafety}` },
      ],
    },
  };
}

// Strengths for the present rating of stresses [Pa]. Teeth of rolling planets are loaded on both flanks.
function limits(setup, record) {
  const [bending, contact, idler] = ["bending_strength", "contact_strength", "idler_factor"]
    .map((name) => setup.value(`strength.${name}`));
  const isRolling = rolls(record, setup.value("geometry.planet_count"), Math.PI / setup.value("geometry.planet_teeth"));
  return { planet: isRolling ? idler * bending : bending, side: bending, contact };
}

// True if one of `planets` planets was rolling between the points around the time of the record; `half` is half a pitch
// [rad]. Rocking within a tooth pitch brings no new tooth into mesh.
export function rolls(record, planets, half) {
  const names = planetNames(planets).map((planet) => `${planet}.spin_angle`).filter((name) => record.has(name));
  return names.map((name) => record.column(name)).some((angles) => {
    let place = 0;
    let isRolling = false;
    for (let k = 1; k <= record.high; k += 1) {
      const wanted = place + angles[k] - angles[k - 1];
      place = clamp(wanted, -half, half);
      isRolling = wanted !== place;
    }
    return isRolling;
  });
}

// Parts are coloured by the present heating power of each cause, at its location.
function byHeat({ setup, record, mostHeat }) {
  const powers = new Map();
  const lines = [];
  const off = [];
  for (const name of heats(setup.table)) {
    const [place, words] = PLACES[name] ?? [null, name];
    const { switches } = setup.table.find(name);
    const power = record.rate(name);
    const isOff = switches.length > 0 && !switches.some((each) => setup.value(each)) && record.largest(name) === 0;
    if (isOff) off.push(`${words} (${switches[0]})`);
    else lines.push({ words, power, place });
    if (!isOff && place) powers.set(place, (powers.get(place) ?? 0) + power);
  }
  const colour = (power) => scaled(mostHeat > 0 ? power / mostHeat : 0);
  const { meshes, plates, ...parts } = Object.fromEntries([...powers].map(([place, power]) => [place, colour(power)]));
  const mesh = powers.get("meshes") > FAINT ? { share: 1, colour: meshes } : DARK;
  return {
    // the library provides only the sum of all meshes
    mesh: (share) => (share > 0.01 ? mesh : DARK),
    pair: () => mesh,
    parts,
    // the library provides only the sum of both clutches
    plates: Object.fromEntries(["left", "right"].map((side) => [side, { share: plates ? 1 : 0, colour: plates }])),
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
  const places = grouped(heats(table), (name) => PLACES[name]?.[0] ?? name);
  const { times } = record;
  let most = 0;
  for (const names of places.values()) {
    const columns = names.map((name) => record.column(name));
    for (let i = 1; i < times.length; i += 1) {
      // a jump of an input has two rows at one time
      if (times[i] === times[i - 1]) continue;
      const gained = columns.reduce((sum, column) => sum + column[i] - column[i - 1], 0);
      most = Math.max(most, gained / (times[i] - times[i - 1]));
    }
  }
  return most;
}

// Explains the picture's colours, with the values at the time of the picture.
export class Legend {
  // `switchOn(name)` is called to switch on an effect that provides missing values.
  constructor(host, switchOn) {
    Object.assign(this, { host, switchOn, shown: "" });
  }

  show(mode, legend) {
    const { lines, scale, off } = legend;
    const plain = JSON.stringify([mode, lines.map(({ text, colour }) => [text, colour && css(colour)]), scale, off]);
    if (plain === this.shown) return;
    this.shown = plain;
    this.host.hidden = false;
    const parts = lines.map(({ text, colour }) => {
      const mark = element("i");
      mark.style.background = colour ? css(colour) : "none";
      return element("li", {}, mark, text);
    });
    const bar = element("div", { className: "bar" });
    bar.style.setProperty("--scale", gradient());
    const made = [element("ul", {}, ...parts)];
    if (scale) made.unshift(element("p", { className: "ends" }, scale.least, bar, scale.most));
    if (off) made.push(this.missing(off));
    this.host.replaceChildren(...made);
  }

  missing({ text, name }) {
    const line = element("p", { className: "off" }, text);
    if (name) {
      const button = element("button", { type: "button", textContent: name, title: `Switch ${name} on` });
      button.addEventListener("click", () => this.switchOn(name));
      line.append(" ", button);
    }
    return line;
  }
}
