// Positions of the gears: x is the carrier's axis, the left side gear points along +x, and planet i along y turned
// about x.
import { Matrix4, Vector3 } from "three";

const X = new Vector3(1, 0, 0);
const aboutX = (angle) => new Matrix4().makeRotationX(angle);
const aboutZ = (angle) => new Matrix4().makeRotationZ(angle);
const axes = (x, y, z) => new Matrix4().makeBasis(new Vector3(...x), new Vector3(...y), new Vector3(...z));

// Columns: axes of a gear's own frame (z from apex to heel, tooth 0 at x) in the assembly.
const LEFT = axes([0, 1, 0], [0, 0, 1], [1, 0, 0]);
const RIGHT = axes([0, 1, 0], [0, 0, -1], [-1, 0, 0]);
const PLANET = axes([1, 0, 0], [0, 0, -1], [0, 1, 0]);

export class Assembly {
  // Teeth and planets are counts; `planet` and `side` are the gears' cones, and the pressure angle is in rad.
  constructor({ planetTeeth, sideTeeth, planets, pressureAngle, planet, side }) {
    Object.assign(this, { planetTeeth, sideTeeth, planets, pressureAngle, cones: planet, sideCones: side });
    this.half = Math.PI / sideTeeth;
    // a planet with an odd number of teeth has a gap opposite the tooth that faces left
    this.rightGap = planetTeeth % 2 === 0 ? this.half : 0;
  }

  azimuth(planet) {
    return (2 * Math.PI * planet) / this.planets;
  }

  // Side gears have a gap at planet 1. Each planet has a tooth in the middle of the gap, or half a pitch from it.
  left(angle) {
    return aboutX(angle).multiply(LEFT).multiply(aboutZ(this.half));
  }

  right(angle) {
    return aboutX(angle).multiply(RIGHT).multiply(aboutZ(this.rightGap));
  }

  planet(planet, carrier, spin) {
    const phase = (Math.floor((2 * this.sideTeeth * planet) / this.planets) % 2) / 2;
    const turned = spin + (phase * 2 * Math.PI) / this.planetTeeth;
    return aboutX(carrier + this.azimuth(planet)).multiply(PLANET).multiply(aboutZ(-turned));
  }

  // Axes of the mesh of a planet with the left (+1) or right (−1) side gear: along its pitch line, forward, and away
  // from the planet.
  axes(planet, side, carrier) {
    const outward = new Vector3(0, 1, 0).applyAxisAngle(X, carrier + this.azimuth(planet));
    const axis = X.clone().multiplyScalar(side);
    const [sine, cosine] = [Math.sin(this.cones.pitch), Math.cos(this.cones.pitch)];
    const line = outward.clone().multiplyScalar(cosine).addScaledVector(axis, sine);
    const apart = axis.clone().multiplyScalar(cosine).addScaledVector(outward, -sine);
    return { outward, line, apart, forward: X.clone().cross(outward) };
  }

  // Pitch line of a mesh, and direction of the force on the side gear if the planet pushes it forward (+1) or back
  // (−1).
  mesh(planet, side, carrier, sense) {
    const { outward, line, apart, forward } = this.axes(planet, side, carrier);
    const force = forward.multiplyScalar(sense * Math.cos(this.pressureAngle));
    force.addScaledVector(apart, Math.sin(this.pressureAngle));
    return { outward, line, force };
  }

  // Direction of the contact line in a mesh. The great circle of action runs through the pitch line toward the force;
  // the result is its point at the polar angle `polar` from the planet's axis.
  contact(planet, side, carrier, sense, polar) {
    const { outward, line, force } = this.mesh(planet, side, carrier, sense);
    // cos(polar) = cos(s) (line·outward) + sin(s) (force·outward) with the arc s from the pitch line
    const [along, across] = [line.dot(outward), force.dot(outward)];
    const most = Math.hypot(along, across);
    const middle = Math.atan2(across, along);
    const apart = Math.acos(Math.min(Math.max(Math.cos(polar) / most, -1), 1));
    // contact is outside the planet's base circle, which the great circle touches in the middle
    const arc = middle + apart;
    return line.multiplyScalar(Math.cos(arc)).addScaledVector(force, Math.sin(arc));
  }
}
