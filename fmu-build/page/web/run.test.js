// Steps and inputs of a run, with a library that only notes them: npm test.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Jumps, Run, tableSlope } from "./run.js";

// The communication points of a scene, and of each step the input at its start and its slope.
function played(table, { stop = 1, step = 0.08, slopes = true, changes = [] } = {}) {
  const points = [], steps = [];
  const noted = { value: 0, slope: 0 };
  const library = {
    start: () => {},
    set: ([{ value }]) => (noted.value = value),
    setSlopes: ([{ value }]) => (noted.slope = value),
    step: (point, size) => {
      points.push(point + size);
      steps.push({ ...noted, size });
    },
  };
  const run = new Run(library, { stop, step, set: [], changes, tables: [{ reference: 0, table }], slopes });
  while (!run.isOver) run.advance();
  return { points, steps };
}

const PULSES = [[0, 0.05, 0.05, 0.1], [100, 100, 0, 0], 0.1];

test("a jump is a communication point in every period, and values change there", () => {
  for (const slopes of [false, true]) {
    const { points, steps } = played(PULSES, { slopes });
    for (let k = 1; k < 20; k += 1) assert.ok(points.some((point) => Math.abs(point - 0.05 * k) < 1e-12), `${0.05 * k}`);
    // half of the time at 100
    const impulse = steps.reduce((sum, { value, size }) => sum + value * size, 0);
    assert.ok(Math.abs(impulse - 50) < 1e-9, String(impulse));
    assert.ok(steps.every(({ slope }) => slope === 0));
  }
});

test("tables continue straight to the end of a step, up to a jump", () => {
  const sawtooth = [[0, 0.3], [0, 3], 0.3];
  const { points, steps } = played(sawtooth, { stop: 0.9, step: 0.25 });
  assert.deepEqual(points.map((point) => Number(point.toFixed(12))), [0.25, 0.3, 0.5, 0.6, 0.75, 0.9]);
  for (const { slope } of steps) assert.ok(Math.abs(slope - 10) < 1e-6, String(slope));
  // mean of 1.5 over 0.9
  const whole = steps.reduce((sum, { value, slope, size }) => sum + (value + slope * size / 2) * size, 0);
  assert.ok(Math.abs(whole - 1.35) < 1e-8, String(whole));
});

test("a period that ends as it begins has no jump there", () => {
  assert.equal(new Jumps([[0, 0.1, 0.3], [0.1, 0.7, 0.1], 0.3]).next, Infinity);
  assert.equal(tableSlope([[0, 1], [0, 2], 1], 0.5, 1), 2);
});

test("changes of the scene stay communication points beside the jumps", () => {
  const { points } = played([[0, 0.05, 0.05], [1, 1, 2], null], { stop: 0.2, step: 0.1, changes: [[0.03, [{ value: 1 }]]] });
  assert.deepEqual(points, [0.03, 0.05, 0.1, 0.2]);
});
