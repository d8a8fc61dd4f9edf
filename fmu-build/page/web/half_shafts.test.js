// Dog clutches are drawn apart when they are open and interlock when they are closed, and their phases have words: node --test.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Box3, MeshStandardMaterial, Vector3 } from "three";
import { clutchTexts, HalfShaft } from "./half_shafts.js";

const [REACH, TEETH, LASH] = [40, 24, 0.02];
const PITCH = (2 * Math.PI) / TEETH;
const OPEN = [0, 1, 2];
const CLOSED = [3, 4];
const sides = [["left", 1], ["right", -1]];

const recordOf = (values) => {
  const read = (name) => values[name] ?? 0;
  return { value: read, point: read, has: (name) => name in values };
};

// Half-shaft with a dog clutch, drawn for these values of its side.
function drawn(name, side, values) {
  const shaft = new HalfShaft({
    side, reach: REACH, begin: 20, start: 45, end: 90, dog: { teeth: TEETH, lash: LASH }, ratio: null, metal: () => new MeshStandardMaterial(),
  });
  shaft.turn(recordOf(Object.fromEntries(Object.entries(values).map(([output, value]) => [`${name}.${output}`, value]))), 0);
  shaft.group.updateMatrixWorld();
  return shaft;
}

// Meshes of the ring on the side gear and of the ring on the half-shaft.
function ringsOf(shaft) {
  const found = [];
  shaft.group.traverse((part) => found.push(part));
  return shaft.rings.map((metal) => found.find(({ material }) => material === metal));
}

for (const [name, side] of sides) {
  test(`the rings are apart in the phases ${OPEN} and interlock in the phases ${CLOSED}: ${name}`, () => {
    for (const phase of [...OPEN, ...CLOSED]) {
      const [gear, wheel] = ringsOf(drawn(name, side, { dog_phase: phase })).map((ring) => new Box3().setFromObject(ring));
      const gap = side > 0 ? wheel.min.x - gear.max.x : gear.min.x - wheel.max.x;
      if (CLOSED.includes(phase)) assert.ok(gap < -0.05 * REACH, `phase ${phase}: ${gap} mm`);
      else assert.ok(gap > 0.05 * REACH, `phase ${phase}: ${gap} mm`);
    }
  });

  test(`closed teeth are in gaps, however far they turned before and the half-shaft twists: ${name}`, () => {
    for (const [turned, twist] of [[0, 0], [7, 0], [-3, 0.4], [2, -0.4], [0, 0.003]]) {
      const angle = 1.3;
      const shaft = drawn(name, side, { dog_phase: 3, angle, twist, wheel_angle: angle - turned * PITCH - twist });
      // distances of the tips from the middles of the side gear's teeth
      const [own, other] = ringsOf(shaft).map((ring, k) => tips(ring, k === 0 ? side : -side).map((tip) => {
        const turn = Math.atan2(tip.z, tip.y) - angle;
        return Math.abs(turn - PITCH * Math.round(turn / PITCH));
      }));
      assert.ok(Math.min(...other) > Math.max(...own) - 1e-6, `${turned} teeth, twist ${twist}`);
      assert.ok(Math.abs(shaft.parts.wheel.rotation.x - (angle - turned * PITCH - twist)) < 1e-12);
    }
  });
}

// Points of a ring in the scene that are farthest toward `sense`.
function tips(ring, sense) {
  const { position } = ring.geometry.attributes;
  const points = Array.from({ length: position.count }, (_, k) => new Vector3().fromBufferAttribute(position, k).applyMatrix4(ring.matrixWorld));
  const most = Math.max(...points.map(({ x }) => sense * x));
  return points.filter(({ x }) => sense * x > most - 1e-3);
}

test("behind an open clutch, the wheel and its ring turn with the angle of the wheel", () => {
  const shaft = drawn("left", 1, { dog_phase: 0, angle: 2, wheel_angle: 0.5 });
  assert.deepEqual([shaft.parts.gear, shaft.parts.wheel, shaft.sleeve].map(({ rotation }) => rotation.x), [2, 0.5, 0.5]);
});

test("each phase has words, and an unknown phase has a dash", () => {
  const text = (values) => clutchTexts(recordOf(values), { shown: String })["left-dog"];
  const words = [...OPEN, ...CLOSED].map((phase) => text({ "left.dog_phase": phase }));
  assert.deepEqual(words, ["open", "waits for speed", "waits for a gap", "closed", "waits for low torque"]);
  assert.equal(text({}), "–");
});
