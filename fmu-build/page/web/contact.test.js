// Tests of contact lines and of the contact pattern: node --test.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector3 } from "three";
import { Assembly } from "./assembly.js";
import { along, COLUMNS, Pattern, ROWS } from "./pattern.js";

// 10 and 16 teeth at 90 degrees: tan(pitch) = 10/16
const PITCH = Math.atan2(10, 16);
const ALPHA = 0.4;
const assembly = new Assembly({
  planetTeeth: 10, sideTeeth: 16, planets: 2, pressureAngle: ALPHA, planet: { pitch: PITCH, outer: 45, mean: 38, inner: 31 }, side: {},
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
