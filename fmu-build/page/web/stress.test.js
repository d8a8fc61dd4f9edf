// Tests of the limits of stresses, and of the pressures that colour scales leave out: node --test.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Record } from "./record.js";
import { rolls } from "./rolling.js";
import { contactOf, isInSeam, largestPressure } from "./seam.js";

const PITCH = (2 * Math.PI) / 10;

function record(names, rows) {
  const made = new Record(names);
  made.append(Float64Array.from(rows.flat()));
  return made;
}

function rolling(angles) {
  const made = record(["planet[1].spin_angle"], angles.map((angle, i) => [i, angle]));
  return angles.map((_, i) => {
    made.seek(i);
    return rolls(made, 2, PITCH / 2);
  });
}

test("planets roll after they have turned half a pitch, but not while they stand still or rock within a pitch", () => {
  assert.deepEqual(rolling([0, 0.4 * PITCH, 0.6 * PITCH, 0.8 * PITCH]).slice(2), [true, true]);
  assert.equal(rolling([0, 0.4 * PITCH, 0.4 * PITCH])[1], false);
  assert.ok(rolling([0, 0.4, -0.4, 0.4, -0.4].map((share) => share * PITCH)).every((each) => !each));
  assert.equal(rolling([0, 2 * PITCH, 2 * PITCH, 2 * PITCH])[3], false);
});

const VALUES = {
  "geometry.planet_teeth": 10, "geometry.side_teeth": 16, "geometry.module": 4.5e-3, "geometry.face_width": 20e-3,
  "geometry.pressure_angle": Math.PI / 9, "material.young_modulus": 2.07e11, "material.poisson_ratio": 0.25,
};
const setup = { value: (name) => VALUES[name] };

test("the radius at the pitch point follows from two involutes and gives Hertz's pressure of the study", () => {
  const { modulus, face, radius } = contactOf(setup);
  // one pair at the pitch point transmits 16 144 N at the mean cone
  const pressure = Math.sqrt((16144 * modulus) / (Math.PI * face * radius));
  assert.ok(Math.abs(pressure / 2384.6e6 - 1) < 1e-4, `${pressure}`);
});

test("a scale ends at the largest pressure outside the seam, in which the radius is below a quarter", () => {
  const contact = contactOf(setup);
  const pressure = (force, share) => Math.sqrt((force * contact.modulus) / (Math.PI * contact.face * contact.radius * share));
  for (const [share, is] of [[1, false], [0.26, false], [0.24, true]]) {
    for (const sign of [1, -1]) assert.equal(isInSeam(contact, { force: 5e3 * sign, pressures: [0, pressure(5e3, share), 0] }), is);
  }
  const parts = ["tooth", "force", "height", "toe_pressure", "middle_pressure", "heel_pressure"];
  const names = [1, 2, 3].flatMap((k) => parts.map((part) => `mesh.pair[${k}].${part}`));
  const pair = (force, share) => [0, force, 0, pressure(force, share), pressure(force, share), pressure(force, share)];
  const none = [-1, 0, 0, 0, 0, 0];
  const rows = [[0, ...pair(1e4, 1), ...pair(3e3, 0.01), ...none], [1, ...pair(8e3, 0.5), ...none, ...none]];
  assert.ok(Math.abs(largestPressure(record(names, rows), setup) / pressure(8e3, 0.5) - 1) < 1e-12);
  // if all contact is in the seam, its pressure is used
  assert.ok(largestPressure(record(names, [[0, ...pair(3e3, 0.01), ...none, ...none]]), setup) > 0);
});
