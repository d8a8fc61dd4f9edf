// Runs execute their schedules, with a library that only records the calls: npm test.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Run } from "./library.js";

const SCENE = {
  stop: 1, step: 0.5, set: [{ reference: 7, value: 3 }], changes: [[0, ["a"]], [0.2, ["b"]], [0.2, ["c"]]],
  tables: [{ reference: 1, table: [[0, 1], [0, 8], null] }, { reference: 2, table: [[0], [5], 0.5] }],
};
// answer of the library: start, size, end, number of changes, 1 for a jump at the start, 1 for a row at the end, values, slopes
const ROWS = [[0, 0, 0, 0, 0, 1, 0, 5, 0, 0], [0, 0.2, 0.2, 1, 1, 1, 0, 5, 8, 0], [0.2, 0.3, 0.5, 3, 1, 0, 1.6, 5, 8, 0],
  [0.5, 0.5, 1, 3, 0, 1, 4, 5, 8, 0]];

// All calls of the library in a run, each with its arguments.
function called(slopes) {
  const calls = [];
  const numbers = (given) => given.map(({ reference, value }) => [reference, value]);
  const library = {
    schedule: (...question) => (calls.push(["schedule", ...question]), Float64Array.from(ROWS.flat())),
    start: (given, stop) => calls.push(["start", numbers(given), stop]),
    set: (given) => calls.push(["set", typeof given[0] === "string" ? given : numbers(given)]),
    setSlopes: (given) => calls.push(["setSlopes", numbers(given)]),
    step: (begin, size) => calls.push(["step", begin, size]),
  };
  const run = new Run(library, { ...SCENE, slopes });
  const times = [run.time];
  while (!run.isOver) {
    run.advance();
    times.push(run.time);
  }
  // a jump has two rows, and the end of a step at a point of a table has none
  assert.deepEqual(times, [0, 0, 0.2, 0.2, 1]);
  return calls;
}

test("a run requests the schedule of its scene and executes its calls in order", () => {
  assert.deepEqual(called(true), [
    ["schedule", [1, 0.5, 3, 0, 0.2, 0.2, 2, 0, 0, 0, 1, 0, 8, 1, 0.5, 0, 0, 5], 10],
    ["start", [[7, 3], [1, 0], [2, 5]], 1],
    ["set", ["a"]], ["set", [[1, 0], [2, 5]]], ["setSlopes", [[1, 8], [2, 0]]], ["step", 0, 0.2],
    ["set", ["b"]], ["set", ["c"]], ["set", [[1, 1.6], [2, 5]]], ["setSlopes", [[1, 8], [2, 0]]], ["step", 0.2, 0.3],
    ["set", [[1, 4], [2, 5]]], ["setSlopes", [[1, 8], [2, 0]]], ["step", 0.5, 0.5],
  ]);
});

test("a scene without slopes holds the values of its tables", () => {
  const [[, question], ...calls] = called(false);
  assert.deepEqual([question[8], question[15]], [2, 2]);
  assert.deepEqual(calls, called(true).slice(1).filter(([call]) => call !== "setSlopes"));
});
