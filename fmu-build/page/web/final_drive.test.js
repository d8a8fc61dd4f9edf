// Pinion and ring gear roll on each other without slip, and their teeth fill each other's gaps; the joint of the propeller
// shaft turns as in the unit: node --test.
import assert from "node:assert/strict";
import { test } from "node:test";
import { MeshStandardMaterial, Vector3 } from "three";
import { FinalDrive } from "./drive_parts.js";
import { pair, Place } from "./final_drive.js";
import { Toothed } from "./toothed.js";

const PLAIN = {
  pinion_teeth: 10, ring_teeth: 41, mean_radius: 0.09, spiral_angle: 0, hand: "right", pitch_angle: 1.326, ring_side: "left",
  ring_offset: 0.025, azimuth: 0, drive_pressure_angle: 0.349, coast_pressure_angle: 0.349,
};
const DRIVES = {
  bevel: PLAIN,
  "bevel on the right, from below": { ...PLAIN, ring_side: "right", azimuth: -0.7 },
  "spiral bevel": { ...PLAIN, spiral_angle: 0.6 },
  "spiral bevel on the right, left hand": { ...PLAIN, spiral_angle: 0.6, hand: "left", ring_side: "right" },
  spur: { ...PLAIN, pitch_angle: 0, pinion_teeth: 19, ring_teeth: 71 },
  helical: { ...PLAIN, pitch_angle: 0, pinion_teeth: 19, ring_teeth: 71, spiral_angle: 0.45, ring_side: "right" },
  "equal gears": { ...PLAIN, pitch_angle: 0.785, pinion_teeth: 30, ring_teeth: 30 },
  "a pinion larger than the ring gear": { ...PLAIN, pinion_teeth: 41, ring_teeth: 30 },
};
const metal = () => new MeshStandardMaterial();

// Velocity of a material point that is at `position` at the angle of a part, per angle of the carrier.
function velocity(matrixAt, position) {
  const own = position.clone().applyMatrix4(matrixAt(0).invert());
  const [before, after] = [-1e-4, 1e-4].map((angle) => own.clone().applyMatrix4(matrixAt(angle)));
  return after.sub(before).divideScalar(2e-4);
}

for (const [name, drive] of Object.entries(DRIVES)) {
  const { ratio, ring, pinion } = pair(drive);
  const place = new Place(drive);

  test(`nothing slips at the pitch point, and the carrier drives forward: ${name}`, () => {
    const [one, other] = [(angle) => place.ring(angle), (angle) => place.pinion(ratio * angle)].map((at) => velocity(at, place.pitchPoint));
    assert.ok(one.distanceTo(other) < 1e-5 * ring.radius, `${one.toArray()} is not ${other.toArray()}`);
    // forward is +z, so the top of a forward ring gear moves forward
    const top = velocity((angle) => place.ring(angle), place.ringCentre.clone().add(new Vector3(0, ring.radius, 0)));
    assert.ok(top.z > 0.99 * ring.radius);
  });

  test(`teeth of the pinion are in gaps of the ring gear: ${name}`, () => {
    const [gear, other] = [ring, pinion].map((one) => new Toothed(one));
    let deepest = -Infinity;
    for (let k = 0; k < 8; k += 1) {
      const angle = (k / 8) * ((2 * Math.PI) / ring.teeth);
      const toRing = place.ring(angle).invert().multiply(place.pinion(ratio * angle));
      for (const along of [-0.4, 0, 0.4].map((part) => part * pinion.width)) {
        for (const { angle: own, height } of other.profile(12)) {
          const [radius, z] = other.point(along, height);
          const turn = own + along * pinion.twist;
          const at = new Vector3(radius * Math.cos(turn), radius * Math.sin(turn), z).applyMatrix4(toRing);
          deepest = Math.max(deepest, depth(gear, at));
        }
      }
    }
    const module = (2 * ring.radius) / ring.teeth;
    // the approximation of the profiles, and flanks that are nearly in contact
    assert.ok(deepest < 0.03 * module, `${deepest / module} modules deep`);
    assert.ok(deepest > -0.1 * module, `${-deepest / module} modules apart`);
  });
}

// Depth of a point in the nearest tooth of a gear along its circumference [mm]; negative in a gap.
function depth(gear, { x, y, z }) {
  const radius = Math.hypot(x, y) - gear.radius;
  const along = radius * gear.sine + z * gear.cosine;
  const height = (radius * gear.cosine - z * gear.sine) / (1 + (along * gear.sine) / gear.radius);
  if (height > gear.top || Math.abs(along) > gear.width / 2) return -Infinity;
  const turn = Math.atan2(y, x) - along * gear.twist;
  const aside = Math.abs(turn - gear.pitch * Math.round(turn / gear.pitch));
  return (gear.halfAngle(Math.max(height, gear.bottom)) - aside) * Math.hypot(x, y);
}

test("the joint turns the tube with tan θ₂ = cos β tan θ₁, or tan θ₁ / cos β with a quarter turn", () => {
  const angle = 0.5;
  for (const quarter of [false, true]) {
    const { shaft } = new FinalDrive({ ...PLAIN, hasShaft: true, joint_angle: angle, joint_quarter_turn: quarter }, metal);
    const across = () => new Vector3().setFromMatrixColumn(shaft.tube.matrix, 0);
    shaft.turn(0);
    const start = across();
    for (const turn of [0.3, 1, 1.5]) {
      shaft.turn(turn);
      const factor = quarter ? 1 / Math.cos(angle) : Math.cos(angle);
      assert.ok(Math.abs(Math.tan(start.angleTo(across())) / (factor * Math.tan(turn)) - 1) < 1e-9);
    }
  }
});

test("a drive with extreme numbers can be built", () => {
  const extremes = [
    { pinion_teeth: 1, ring_teeth: 1 }, { pinion_teeth: 1000, ring_teeth: 1 }, { pinion_teeth: 1, ring_teeth: 1000 },
    { pinion_teeth: 1000, ring_teeth: 1000, spiral_angle: 1.2 }, { pitch_angle: Math.PI / 2, ring_offset: -1 }, { mean_radius: 1e-3 },
    { pitch_angle: 1e-9, azimuth: Math.PI / 2 }, { drive_pressure_angle: 0, coast_pressure_angle: 0 },
  ];
  for (const own of extremes) {
    const drive = new FinalDrive({ ...PLAIN, ...own, hasShaft: true, joint_angle: 1.2, joint_quarter_turn: true }, metal);
    for (const { geometry } of [drive.ring, drive.pinion.children[0]]) {
      assert.ok(geometry.attributes.position.array.every(Number.isFinite), JSON.stringify(own));
    }
  }
});
