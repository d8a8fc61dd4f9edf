// Contact of tooth pairs in the mesh of planet 1 with the left side gear, which the library lists individually: their
// pressures, the seam at the foot of a flank, and the contact pattern.
import { clamp } from "./table.js";

export const CONTACT = "scene.gear_contact";
const TEETH = ["tooth", "solid"]; // literals of the gear contact with teeth
const MOST = 3; // pairs
const at = (k, part) => `mesh.pair[${k}].${part}`;
const PLACE = ["tooth", "force", "height"];
const PRESSURES = ["toe_pressure", "middle_pressure", "heel_pressure"];
const each = Array.from({ length: MOST }, (_, k) => k + 1);
// relative radius of the flanks divided by that at the pitch point, below which the foot of a flank is a seam
const LEAST_RADIUS = 0.25;
// rows of a contact pattern from root to tip, and its columns from toe to heel
export const ROWS = 96;
export const COLUMNS = 33;

export const pairNames = (withPressures) =>
  each.flatMap((k) => [...PLACE, ...(withPressures ? PRESSURES : [])].map((part) => at(k, part)));

// True if gears have teeth that touch individually.
export const hasTeeth = (setup) => TEETH.includes(setup.table.shown(CONTACT, setup.value(CONTACT)));

// True if the record contains tooth pairs, and their pressures if requested.
export const hasPairs = (record, withPressures = false) => pairNames(withPressures).every((name) => record.has(name));

export const pairColumns = (record) => Object.fromEntries(pairNames(true).map((name) => [name, record.column(name)]));

// Pairs in contact: [{tooth, force, height, pressures: [toe, middle, heel]}]. `value(name)` is a number of one point,
// not interpolated: between two points pairs come and go, and their positions in the list change.
export function pairs(value) {
  return each.filter((k) => value(at(k, "tooth")) >= 0 && value(at(k, "force")) !== 0).map((k) => ({
    tooth: value(at(k, "tooth")), force: value(at(k, "force")), height: value(at(k, "height")),
    pressures: PRESSURES.map((part) => value(at(k, part))),
  }));
}

// Quantities that determine pressures of a set-up: modulus of the contact [Pa], face width [m], relative radius at the
// pitch point [m].
export function contactOf(setup) {
  const value = (name) => setup.value(name);
  const [planet, side] = ["planet", "side"].map((gear) => value(`geometry.${gear}_teeth`));
  const face = value("geometry.face_width");
  const mean = 0.5 * value("geometry.module") * Math.hypot(planet, side) - 0.5 * face;
  // tangent of the arc from a base circle to the pitch point: cos δ = cos δ_b cos ψ, sin δ_b = sin δ cos α
  const tangentOfArc = (pitchAngle) => Math.sin(value("geometry.pressure_angle")) * Math.tan(pitchAngle);
  const [one, other] = [tangentOfArc(Math.atan2(planet, side)), tangentOfArc(Math.atan2(side, planet))];
  const modulus = value("material.young_modulus") / (2 * (1 - value("material.poisson_ratio") ** 2));
  return { modulus, face, radius: (mean * one * other) / (one + other) };
}

// True if the middle of a pair is in the seam at the foot of a flank. Toward a base circle, the flank's radius approaches
// zero. Hertz's pressure grows without limit there and has no meaning, so colour scales leave the seam out.
export const isInSeam = ({ modulus, face, radius }, { force, pressures }) =>
  Math.PI * face * LEAST_RADIUS * radius * pressures[1] ** 2 > Math.abs(force) * modulus;

// Largest pressure of a record outside the seam [Pa]; if there is none, the largest one inside it.
export function largestPressure(record, setup) {
  const contact = contactOf(setup);
  const columns = pairColumns(record);
  let [sound, all] = [0, 0];
  for (let i = 0; i < record.count; i += 1) {
    for (const pair of pairs((name) => columns[name][i])) {
      const most = Math.max(...pair.pressures);
      all = Math.max(all, most);
      if (!isInSeam(contact, pair)) sound = Math.max(sound, most);
    }
  }
  return sound || all;
}

// Pressure at a fraction of the distance from toe to heel, interpolated linearly between the three values of the
// library.
export function along([toe, middle, heel], share) {
  return share < 0.5 ? toe + 2 * share * (middle - toe) : middle + (2 * share - 1) * (heel - middle);
}

// Contact pattern of a flank: the largest pressure so far at each position. A contact line is one row, because all
// contact lines run to the apex.
export class Pattern {
  // Heights of root and tip over the pitch circle at the mean cone distance [m].
  constructor(root, tip) {
    Object.assign(this, { root, tip, most: 0, largest: new Float64Array(ROWS * COLUMNS), before: [] });
  }

  // Adds the pairs of the next point. Positions that a contact line passed since the last point count, too.
  add(pairs) {
    for (const pair of pairs) {
      const last = this.before.find(({ tooth }) => tooth === pair.tooth) ?? pair;
      const [from, to] = [this.row(last.height), this.row(pair.height)];
      const steps = Math.abs(to - from);
      for (let k = 0; k <= steps; k += 1) {
        const share = steps > 0 ? k / steps : 1;
        const pressures = pair.pressures.map((pressure, i) => last.pressures[i] + share * (pressure - last.pressures[i]));
        this.press(from + Math.sign(to - from) * k, pressures);
      }
    }
    this.before = pairs;
  }

  row(height) {
    const share = (height - this.root) / (this.tip - this.root);
    return clamp(Math.round(share * (ROWS - 1)), 0, ROWS - 1);
  }

  press(row, pressures) {
    for (let column = 0; column < COLUMNS; column += 1) {
      const pressure = along(pressures, column / (COLUMNS - 1));
      const place = row * COLUMNS + column;
      this.largest[place] = Math.max(this.largest[place], pressure);
      this.most = Math.max(this.most, pressure);
    }
  }
}
