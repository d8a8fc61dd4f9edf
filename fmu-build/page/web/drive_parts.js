// Parts of the final drive in the scene: ring gear, pinion, and the propeller shaft in front of it.
import { BoxGeometry, CylinderGeometry, Group, Mesh, Vector3 } from "three";
import { pair, Place } from "./final_drive.js";
import { coupling, MARK, move, placed } from "./housing.js";
import { PropellerShaft } from "./propeller.js";
import { paint } from "./steel.js";
import { Toothed } from "./toothed.js";

const OWN = { ring: "#a3a9a1", pinion: "#c07a4a", grey: "#8b929b" };
const GEAR = 0.36; // roughness
const ROUND = 32;

// usual proportions
const RIM = 1.2; // thickness of the ring gear behind its teeth per module
const WEB = 6; // mm: thickness of the flange that bears the ring gear
// shaft of the pinion: its radius per root radius and at most per radius of the ring gear, and its length per face width
// and per radius of the pinion
const STEM = { root: 0.62, ring: 0.25, face: 1.2, radius: 0.8 };

export class FinalDrive {
  // `drive` from `drawnDrive`; `metal(colour, roughness)` creates a material.
  constructor(drive, metal) {
    this.metals = { ring: metal(OWN.ring, GEAR), pinion: metal(OWN.pinion, GEAR) };
    this.pair = pair(drive);
    this.place = new Place(drive);
    this.ring = this.ringGear();
    this.pinion = this.pinionWithShaft(metal);
    this.group = new Group();
    this.group.add(this.ring, this.pinion);
    if (drive.hasShaft) {
      this.shaft = new PropellerShaft(this.place, this.end, this.stem, drive, metal);
      this.group.add(this.shaft.group);
    }
    this.turn({ carrier: 0, pinion: 0, propeller: 0 });
  }

  ringGear() {
    const { ring, module } = this.pair;
    const gear = new Toothed(ring);
    const { toe: [toe, front], heel: [heel, back] } = gear.root;
    const rear = back + RIM * module * gear.sine;
    const bore = Math.max(Math.min(toe, heel) - RIM * module * (0.3 + 0.7 * gear.cosine), 0.3 * ring.radius);
    const surface = gear.surface([[bore, rear], [bore, front]], [[heel, rear], [bore, rear]]);
    // the flange is at the back of a bevel ring gear, and in the middle of a cylindrical one
    const inset = Math.max(WEB / 2, (gear.cosine * (rear - front)) / 2);
    const { side, ringCentre } = this.place;
    this.seat = { side, outer: bore, thick: WEB, place: side * ringCentre.x + rear - inset };
    this.outer = gear.point(ring.width / 2, gear.top)[0];
    return placed(new Mesh(surface, this.metals.ring));
  }

  pinionWithShaft(metal) {
    const { pinion, ring } = this.pair;
    const gear = new Toothed(pinion);
    const { toe: [toe, front], heel: [heel, back] } = gear.root;
    const radius = Math.min(STEM.root * Math.min(toe, heel), STEM.ring * ring.radius);
    const [begin, length] = [back + 0.25 * radius, STEM.face * pinion.width + STEM.radius * pinion.radius];
    const surface = gear.surface(
      [[0, front - 0.4 * radius], [radius, front - 0.4 * radius], [radius, front]],
      [[heel, back], [heel, begin], [radius, begin + 0.4 * radius]],
    );
    const shaft = new CylinderGeometry(radius, radius, length, ROUND).rotateX(Math.PI / 2).translate(0, 0, begin + length / 2);
    // a stripe makes the rotation visible
    const stripe = new Mesh(new BoxGeometry(0.25 * radius, 0.25 * radius, 0.6 * length), metal(MARK, 0.6));
    stripe.position.set(radius, 0, begin + 0.55 * length);
    const group = placed(new Group());
    group.add(new Mesh(surface, this.metals.pinion), new Mesh(shaft, this.metals.pinion), stripe);
    group.add(coupling(begin + length, radius, this.metals.pinion, metal));
    this.stem = radius;
    this.end = this.place.pinionCentre.clone().addScaledVector(this.place.axis, begin + length);
    return group;
  }

  // Angles in rad; those of pinion and propeller shaft are positive in forward drive.
  turn({ carrier, pinion, propeller }) {
    move(this.ring, this.place.ring(carrier));
    move(this.pinion, this.place.pinion(pinion));
    this.shaft?.turn(propeller);
  }

  // Sphere [centre, radius] around ring gear and pinion.
  get bounds() {
    const reach = this.end.length();
    const centre = this.end.clone().multiplyScalar(Math.max(reach - this.outer, 0) / (2 * reach));
    return [centre, Math.max(this.outer, (reach + this.outer) / 2)];
  }

  // Positions of names next to the parts.
  get labels() {
    const { pinionCentre, ringCentre, outward, radial } = this.place;
    const { pinion } = this.pair;
    const beside = 0.85 * this.outer;
    return {
      pinion: pinionCentre.clone().addScaledVector(radial, 1.6 * pinion.radius).addScaledVector(outward, -2.6 * pinion.radius),
      ring: ringCentre.clone().addScaledVector(radial, -beside).add(new Vector3(0, beside, 0)),
    };
  }

  // Colours the parts by their names in colouring.js.
  paint({ drive, propeller }, isGrey) {
    paint(this.metals.ring, isGrey ? OWN.grey : OWN.ring, drive);
    paint(this.metals.pinion, isGrey ? OWN.grey : OWN.pinion, drive);
    this.shaft?.paint(propeller);
  }
}
