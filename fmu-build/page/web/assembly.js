// Where the gears stand: x is the carrier's axis, the left side gear points along +x, planet i along y turned about x.
import { Matrix4, Vector3 } from "three";

const X = new Vector3(1, 0, 0);
const aboutX = (angle) => new Matrix4().makeRotationX(angle);
const aboutZ = (angle) => new Matrix4().makeRotationZ(angle);
const axes = (x, y, z) => new Matrix4().makeBasis(new Vector3(...x), new Vector3(...y), new Vector3(...z));

// Columns: where the axes of a gear's own frame (z from apex to heel, tooth 0 at x) lie in the assembly.
const LEFT = axes([0, 1, 0], [0, 0, 1], [1, 0, 0]);
const RIGHT = axes([0, 1, 0], [0, 0, -1], [-1, 0, 0]);
const PLANET = axes([1, 0, 0], [0, 0, -1], [0, 1, 0]);

export class Assembly {
  // Teeth and planets are counts; angles [rad] and lengths [mm] of the pair.
  constructor({ planetTeeth, sideTeeth, planets, planetPitch, outerCone, pressureAngle }) {
    Object.assign(this, { planetTeeth, sideTeeth, planets, planetPitch, outerCone, pressureAngle });
    this.half = Math.PI / sideTeeth;
    // a planet with an odd number of teeth shows a gap behind the tooth that faces the left
    this.rightGap = planetTeeth % 2 === 0 ? this.half : 0;
  }

  azimuth(planet) {
    return (2 * Math.PI * planet) / this.planets;
  }

  // Side gears have a gap at planet 1; each planet is at the tooth in the middle of the gap, or half a pitch on.
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

  // Mesh of a planet with the left (+1) or right (−1) side gear: its pitch line, and the direction of the force on the side
  // gear when the planet pushes it forward (+1) or back (−1).
  mesh(planet, side, carrier, sense) {
    const outward = new Vector3(0, 1, 0).applyAxisAngle(X, carrier + this.azimuth(planet));
    const forward = X.clone().cross(outward);
    const axis = X.clone().multiplyScalar(side);
    const [sine, cosine] = [Math.sin(this.planetPitch), Math.cos(this.planetPitch)];
    const line = outward.clone().multiplyScalar(cosine).addScaledVector(axis, sine);
    const apart = axis.clone().multiplyScalar(cosine).addScaledVector(outward, -sine);
    const force = forward.multiplyScalar(sense * Math.cos(this.pressureAngle));
    force.addScaledVector(apart, Math.sin(this.pressureAngle));
    return { line, force };
  }
}
