// Geometry of the final drive: the pair of pinion and ring gear from the parameters of a set-up, and their positions.
//
// x is the axle, with the left at +x; y is upward and z forward. The azimuth of the mesh counts from z toward y. Face width
// and tooth heights are not parameters of the unit; usual proportions replace them. Lengths are in mm, angles in rad.
import { Matrix4, Vector3 } from "three";
import { clamp } from "./table.js";

const FINAL_DRIVE = "effects.final_drive";
const PROPELLER_SHAFT = "effects.propeller_shaft";
// parameters that determine the picture
const NAMES = [
  "pinion_teeth", "ring_teeth", "mean_radius", "spiral_angle", "hand", "pitch_angle", "ring_side", "ring_offset", "azimuth",
  "drive_pressure_angle", "coast_pressure_angle",
].map((name) => `final_drive.${name}`);
const JOINT = ["joint_angle", "joint_quarter_turn"].map((name) => `propeller_shaft.${name}`);
const LEFT = "left"; // literal of the side
const RIGHT_HAND = "right"; // literal of the hand
const MM = 1e3; // mm in a metre

// usual proportions
const FACE = { module: 7, cone: 0.3, diameter: 0.6 }; // largest face width per module, cone distance, smaller pitch diameter
const SHIFT = 0.43; // profile shift of the pinion if the ratio is large
const PRESSURE = [0.2, 0.5]; // range of the drawn transverse pressure angle

const FORCES = ["tangential", "axial", "radial"].map((direction) => `ring_gear.${direction}_force`);

export const hasFinalDrive = (setup) => setup.value(FINAL_DRIVE);

// Outputs for the picture of a set-up.
export function driveOutputs(setup) {
  if (!hasFinalDrive(setup)) return [];
  return ["pinion.angle", "pinion.speed", ...FORCES, ...(setup.value(PROPELLER_SHAFT) ? ["propeller.angle"] : [])];
}

// Largest force on the ring gear in a record [N]; 0 if the record does not contain it.
export function largestRingForce(record) {
  if (!FORCES.every((name) => record.has(name))) return 0;
  const [along, ...others] = FORCES.map((name) => record.column(name));
  return along.reduce((most, value, i) => Math.max(most, Math.hypot(value, ...others.map((column) => column[i]))), 0);
}

// Values that determine the picture, by their names without the group. Null without a final drive, and if a value is out of
// range, because the library then refuses it. `value(name)` is in SI; choices are the names of their literals.
export function drawnDrive(table, value) {
  if (!value(FINAL_DRIVE)) return null;
  const hasShaft = value(PROPELLER_SHAFT);
  const variables = [...NAMES, ...(hasShaft ? JOINT : [])].map((name) => table.find(name));
  const isAllowed = ({ name, min, max }) => min === null || (value(name) >= min && value(name) <= max);
  if (!variables.every(isAllowed)) return null;
  const read = ({ name, literals }) => literals.find((literal) => literal.value === value(name))?.name ?? value(name);
  return { ...Object.fromEntries(variables.map((variable) => [variable.name.split(".")[1], read(variable)])), hasShaft };
}

// Geometry of the pair in mm and rad: both gears as for `Toothed`, and the place of the mesh.
export function pair(drive) {
  const { pinion_teeth: pinionTeeth, ring_teeth: ringTeeth, spiral_angle: spiral } = drive;
  const ratio = ringTeeth / pinionTeeth;
  const radius = MM * drive.mean_radius;
  // a pinion larger than the ring gear has a pitch cone only if that of the ring gear is small enough
  const cone = Math.min(drive.pitch_angle, Math.asin(Math.min(ratio, 1)));
  const sine = Math.sin(cone);
  const module = (2 * radius) / ringTeeth;
  const small = Math.min(radius, radius / ratio);
  const width = Math.min(FACE.module * module, FACE.diameter * 2 * small, sine > 0 ? (FACE.cone * radius) / sine : Infinity);
  const normal = (drive.drive_pressure_angle + drive.coast_pressure_angle) / 2;
  const height = module * Math.cos(spiral);
  const pressureAngle = clamp(Math.atan(Math.tan(normal) / Math.cos(spiral)), ...PRESSURE);
  const hand = drive.hand === RIGHT_HAND ? 1 : -1;
  const twist = (hand * Math.tan(spiral)) / radius;
  const shift = ratio > 1 ? SHIFT * (1 - 1 / ratio ** 2) : -SHIFT * (1 - ratio ** 2);
  const common = { width, height, pressureAngle };
  return {
    ratio, module, cone,
    ring: { ...common, teeth: ringTeeth, radius, cone, shift: -shift, twist },
    // the pinion has the opposite hand, and its teeth meet the gaps at all cone distances
    pinion: {
      ...common, teeth: pinionTeeth, radius: radius / ratio, cone: Math.asin(Math.min(sine / ratio, 1)), shift, twist: -ratio * twist,
    },
  };
}

// Axes of the mesh in the scene, in which the gears do not move.
export class Place {
  constructor(drive) {
    const { cone, ring, pinion } = pair(drive);
    const between = cone + pinion.cone; // shaft angle
    this.side = drive.ring_side === LEFT ? 1 : -1;
    this.outward = new Vector3(this.side, 0, 0);
    this.radial = new Vector3(0, Math.sin(drive.azimuth), Math.cos(drive.azimuth));
    this.motion = new Vector3(1, 0, 0).cross(this.radial); // direction of the teeth in forward drive
    this.above = this.motion.clone().multiplyScalar(this.motion.y > 0 ? 1 : -1); // the same line, upward
    const along = (outward, radial) => this.outward.clone().multiplyScalar(outward).addScaledVector(this.radial, radial);
    this.ringCentre = new Vector3(this.side * MM * drive.ring_offset, 0, 0);
    this.pitchPoint = this.ringCentre.clone().addScaledVector(this.radial, ring.radius);
    // axis of the pinion toward its shaft, and direction from its axis to the mesh
    this.axis = along(Math.cos(between), Math.sin(between));
    this.toMesh = along(Math.sin(between), -Math.cos(between));
    this.line = along(Math.cos(cone), Math.sin(cone)); // pitch line toward the heel
    this.pinionCentre = this.pitchPoint.clone().addScaledVector(this.toMesh, -pinion.radius);
    this.half = Math.PI / ring.teeth;
  }

  // Force of the pinion on the ring gear [N], from the outputs of the unit.
  force(read) {
    const [tangential, axial, radial] = FORCES.map(read);
    return this.motion.clone().multiplyScalar(tangential).addScaledVector(this.outward, axial).addScaledVector(this.radial, -radial);
  }

  // The ring gear turns with the carrier. A gap is at the pitch point at the angle 0.
  ring(carrier) {
    return frame(this.radial, this.outward, this.ringCentre).multiply(aboutZ(this.side * carrier + this.half));
  }

  // The pinion turns against the ring gear. A tooth is at the pitch point at the angle 0.
  pinion(angle) {
    return frame(this.toMesh, this.axis, this.pinionCentre).multiply(aboutZ(this.turn(angle)));
  }

  // Angle of a shaft about the axis of the pinion, if `angle` is positive in forward drive.
  turn(angle) {
    return -this.side * angle;
  }
}

const aboutZ = (angle) => new Matrix4().makeRotationZ(angle);

// Frame with the axes x and z, at a position.
export function frame(x, z, position) {
  return new Matrix4().makeBasis(x, z.clone().cross(x), z).setPosition(position);
}
