// Propeller shaft in front of the pinion: a tube, a universal joint, and the driven end.
//
// The cross of the joint has one arm on the driven end, across its axis, and the other one on the tube. It thereby gives the
// tube the angle θ₂ with tan θ₂ = cos(joint angle) tan θ₁. Lengths are in mm, angles in rad.
import { BoxGeometry, CylinderGeometry, Group, Mesh, Quaternion, Vector3 } from "three";
import { frame } from "./final_drive.js";
import { COUPLING, coupling, MARK, move, placed } from "./housing.js";
import { paint } from "./steel.js";

const OWN = "#767d88";
const DARK = "#4b5058";
// lengths and radii per radius of the pinion's shaft
const LONG = { tube: 9, fork: 1.5, end: 4 };
const THICK = { tube: 1.15, arm: 0.26 };
const ROUND = 32;
const [Y, Z] = [new Vector3(0, 1, 0), new Vector3(0, 0, 1)];

export class PropellerShaft {
  // `place` of the final drive, position of the pinion's end, radius of the pinion's shaft, values from `drawnDrive`;
  // `metal(colour, roughness)` creates a material.
  constructor(place, start, radius, drive, metal) {
    const size = { radius, length: LONG.tube * radius, fork: LONG.fork * radius, own: metal(OWN), metal };
    Object.assign(this, { place, axis: place.axis, own: size.own });
    // the couplings of pinion and tube touch
    this.joint = start.clone().addScaledVector(this.axis, COUPLING * radius + size.length + size.fork);
    // the driven end is inclined upward in the plane of the joint
    const across = this.axis.clone().cross(Math.abs(this.axis.y) < 0.9 ? Y : Z).normalize();
    this.driven = this.axis.clone().applyAxisAngle(across, drive.joint_angle);
    // arm of the driven end at the angle 0
    this.arm = across.applyAxisAngle(this.driven, drive.joint_quarter_turn ? Math.PI / 2 : 0);
    this.tube = shaft(-1, size);
    this.end = shaft(1, { ...size, length: LONG.end * radius });
    this.arms = [0, 1].map(() => new Mesh(new CylinderGeometry(THICK.arm * radius, THICK.arm * radius, 1.9 * radius, ROUND), metal(DARK)));
    for (const arm of this.arms) arm.position.copy(this.joint);
    this.group = new Group();
    this.group.add(this.tube, this.end, ...this.arms);
  }

  // Turns the driven end by an angle that is positive in forward drive.
  turn(angle) {
    const arm = this.arm.clone().applyAxisAngle(this.driven, this.place.turn(angle));
    const other = this.axis.clone().cross(arm).normalize();
    move(this.end, frame(arm, this.driven, this.joint));
    move(this.tube, frame(other, this.axis, this.joint));
    [arm, other].forEach((direction, k) => this.arms[k].quaternion.copy(new Quaternion().setFromUnitVectors(Y, direction)));
  }

  paint(colour) {
    paint(this.own, OWN, colour);
  }
}

// Shaft along z with the joint at the origin and its arm along x: prongs that hold the arm, a cylinder, and a coupling.
// `sense` is the direction from the joint to the shaft.
function shaft(sense, { radius, length, fork, own, metal }) {
  const middle = sense * (fork + length / 2);
  const bar = new CylinderGeometry(THICK.tube * radius, THICK.tube * radius, length, ROUND).rotateX(Math.PI / 2).translate(0, 0, middle);
  // a stripe makes the rotation visible
  const stripe = new Mesh(new BoxGeometry(0.25 * radius, 0.25 * radius, 0.7 * length), metal(MARK, 0.6));
  stripe.position.set(THICK.tube * radius, 0, middle);
  const prongs = [1, -1].map((k) => {
    const prong = new Mesh(new BoxGeometry(0.35 * radius, 0.9 * radius, fork + THICK.arm * radius), own);
    prong.position.set(k * 0.8 * radius, 0, (sense * (fork - THICK.arm * radius)) / 2);
    return prong;
  });
  const group = placed(new Group());
  group.add(new Mesh(bar, own), stripe, ...prongs, coupling(sense * (fork + length), radius, own, metal));
  return group;
}
