// Seam at the foot of a flank: toward a base circle, the flank's radius approaches zero. Hertz's pressure grows without
// limit there and has no meaning, so colour scales leave the seam out.
import { pairNames, pairs } from "./pairs.js";

// Relative radius of the flanks divided by that at the pitch point, below which the foot of a flank is a seam.
const LEAST_RADIUS = 0.25;

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

export const isInSeam = ({ modulus, face, radius }, { force, pressures }) =>
  Math.PI * face * LEAST_RADIUS * radius * pressures[1] ** 2 > Math.abs(force) * modulus;

// Largest pressure of a record outside the seam [Pa]; if there is none, the largest one inside it.
export function largestPressure(record, setup) {
  const contact = contactOf(setup);
  const columns = new Map(pairNames(true).map((name) => [name, record.column(name)]));
  let [sound, all] = [0, 0];
  for (let i = 0; i < record.count; i += 1) {
    for (const pair of pairs((name) => columns.get(name)[i])) {
      const most = Math.max(...pair.pressures);
      all = Math.max(all, most);
      if (!isInSeam(contact, pair)) sound = Math.max(sound, most);
    }
  }
  return sound || all;
}
