// Tests of contact lines, of the contact pattern, of rolling planets, and of the pressures that colour scales leave out:
// node --test.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector3 } from "three";
import { largestPower, rolls } from "./colouring.js";
import { along, COLUMNS, contactOf, isInSeam, largestPressure, Pattern, ROWS } from "./contact.js";
import { Assembly } from "./differential.js";
import { Record } from "./record.js";

// 10 and 16 teeth at 90 degrees: tan(pitch) = 10/16
const PITCH = Math.atan2(10, 16);
const ALPHA = 0.4;
const assembly = new Assembly({
  planetTeeth: 10, sideTeeth: 16, planets: 2, pressureAngle: ALPHA, planet: { pitch: PITCH, outer: 45, mean: 38, inner: 31 },
});
const near = (value, expected) => assert.ok(Math.abs(value - expected) < 1e-12, `${value} is not ${expected}`);

for (const [planet, side, carrier, sense] of [[0, 1, 0, 1], [0, 1, 0.7, -1], [1, -1, -2.1, 1]]) {
  const of = `planet ${planet}, side ${side}, sense ${sense}`;
  const { outward, line, force } = assembly.mesh(planet, side, carrier, sense);

  test(`at the pitch angle contact is on the pitch line: ${of}`, () => {
    const direction = assembly.contact(planet, side, carrier, sense, PITCH);
    near(direction.distanceTo(line), 0);
  });

  test(`contact has the polar angle asked for, on the great circle that touches both base cones: ${of}`, () => {
    const axis = new Vector3(side, 0, 0);
    const normal = line.clone().cross(force);
    // sin of the base angle is sin of the pitch angle times cos of the pressure angle, for both gears
    near(Math.abs(normal.dot(outward)), Math.sin(PITCH) * Math.cos(ALPHA));
    near(Math.abs(normal.dot(axis)), Math.cos(PITCH) * Math.cos(ALPHA));
    for (const polar of [PITCH - 0.02, PITCH + 0.05]) {
      const direction = assembly.contact(planet, side, carrier, sense, polar);
      near(direction.length(), 1);
      near(direction.angleTo(outward), polar);
      near(direction.dot(normal), 0);
      // from the pitch line toward the planet's tip, contact is closer to the side gear's axis
      assert.ok(direction.angleTo(axis) < line.angleTo(axis) === polar > PITCH);
    }
  });
}

test("pressure is interpolated linearly between toe, middle and heel", () => {
  const pressures = [4, 2, 3];
  assert.deepEqual([0, 0.25, 0.5, 0.75, 1].map((share) => along(pressures, share)), [4, 3, 2, 2.5, 3]);
});

test("a pattern contains the largest pressure of each position that contact has passed", () => {
  const pattern = new Pattern(-0.002, 0.002);
  const pair = (tooth, height, pressure) => ({ tooth, height, pressures: [pressure, pressure, pressure] });
  pattern.add([pair(3, -0.002, 5)]);
  pattern.add([pair(3, 0.002, 7), pair(4, -0.002, 2)]);
  const column = (row) => pattern.largest[row * COLUMNS + 4];
  assert.equal(column(0), 5);
  assert.equal(column(ROWS - 1), 7);
  for (let row = 1; row < ROWS; row += 1) assert.ok(column(row) >= column(row - 1) && column(row) > 0, `row ${row}`);
  assert.equal(pattern.most, 7);
});

test("a new tooth in contact adds no pressure at positions that no tooth touched", () => {
  const pattern = new Pattern(-0.002, 0.002);
  pattern.add([{ tooth: 0, height: -0.002, pressures: [1, 1, 1] }]);
  pattern.add([{ tooth: 1, height: 0.002, pressures: [1, 1, 1] }]);
  assert.equal(pattern.largest[Math.floor(ROWS / 2) * COLUMNS], 0);
});

const TURN = (2 * Math.PI) / 10; // of a planet by one tooth

function record(names, rows) {
  const made = new Record(names);
  made.append(Float64Array.from(rows.flat()));
  return made;
}

function rolling(angles) {
  const made = record(["planet[1].spin_angle"], angles.map((angle, i) => [i, angle]));
  return angles.map((_, i) => {
    made.seek(i);
    return rolls(made, 2, TURN / 2);
  });
}

test("planets roll after they have turned half a pitch, but not while they stand still or rock within a pitch", () => {
  assert.deepEqual(rolling([0, 0.4 * TURN, 0.6 * TURN, 0.8 * TURN]).slice(2), [true, true]);
  assert.equal(rolling([0, 0.4 * TURN, 0.4 * TURN])[1], false);
  assert.ok(rolling([0, 0.4, -0.4, 0.4, -0.4].map((share) => share * TURN)).every((each) => !each));
  assert.equal(rolling([0, 2 * TURN, 2 * TURN, 2 * TURN])[3], false);
});

test("the largest heating power counts no jump of an input, which has two rows at one time", () => {
  const names = ["heat.clutch", "heat.brake"];
  const table = { outputs: () => names.map((name) => ({ name })) };
  const heated = record(names, [[0, 0, 0], [1, 2, 0], [1, 2, 0], [2, 3, 8], [4, 3, 9]]);
  assert.equal(largestPower(heated, table), 8);
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
