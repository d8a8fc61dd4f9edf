// Surface of a gear with straight or spiral teeth on a pitch cone or a pitch cylinder, for the pair of a final drive.
//
// The profile is the involute of the virtual spur gear on the back cone (Tredgold's approximation), with the radius
// r/cos(pitch angle). The gear's own frame has z along its axis, toward the heel, and its origin in the plane of the mean
// pitch circle. Tooth 0 is centred on x. Lengths are in mm, angles in rad.
import { BufferAttribute, BufferGeometry } from "three";
import { creased } from "./housing.js";
import { clamp } from "./table.js";

const TOP = 1; // addendum per normal module
const BOTTOM = 1.2; // dedendum per normal module
const FREE = 0.02; // fraction of half a tooth that is removed from each side, so that flanks do not flicker
const DEEPEST = 0.6; // maximum dedendum per radius of the virtual gear
const SHARPEST = 0.05; // minimum thickness of a tooth per its pitch
const FLATTEST = 1e-3; // minimum cosine of a pitch angle: a crown gear has no virtual gear
const FACETS = { flank: 6, strip: 5 }; // maximum number of facets of a flank from root to tip and along the tooth
const MOST = 300; // number of teeth of which each flank has one facet; gears with fewer teeth are finer

const involute = (angle) => Math.tan(angle) - angle;

// A gear, made of these numbers:
//   teeth, radius  number of teeth, mean pitch radius
//   cone           pitch angle, 0 for a cylinder
//   width          face width along the pitch line
//   height         normal module, the unit of tooth heights
//   shift          profile shift per normal module
//   pressureAngle  transverse pressure angle
//   twist          angle by which a tooth turns about z per mm along the pitch line
export class Toothed {
  constructor(gear) {
    Object.assign(this, gear);
    this.sine = Math.sin(this.cone);
    this.cosine = Math.cos(this.cone);
    this.pitch = (2 * Math.PI) / this.teeth;
    const least = (-DEEPEST * this.radius) / Math.max(this.cosine, FLATTEST);
    this.bottom = Math.max((this.shift - BOTTOM) * this.height, least);
    this.top = (TOP + this.shift) * this.height;
  }

  // Point of the gear [radius, z] at a distance along the pitch line from its middle, and a height over the pitch cone.
  // Teeth taper toward the apex.
  point(along, height) {
    const tapered = height * (1 + (along * this.sine) / this.radius);
    return [this.radius + along * this.sine + tapered * this.cosine, along * this.cosine - tapered * this.sine];
  }

  get root() {
    return { toe: this.point(-this.width / 2, this.bottom), heel: this.point(this.width / 2, this.bottom) };
  }

  // Half the angle of a tooth about z at a height over the pitch cone.
  halfAngle(height) {
    const flat = Math.max(this.cosine, FLATTEST);
    const radius = this.radius / flat;
    const base = radius * Math.cos(this.pressureAngle);
    const half = (this.pitch * this.radius) / 4 + this.shift * this.height * Math.tan(this.pressureAngle);
    const atPitch = (half * (1 - FREE)) / radius + involute(this.pressureAngle);
    // below the base circle, flanks are radial
    const own = radius + height > base ? involute(Math.acos(base / (radius + height))) : 0;
    return clamp((atPitch - own) / flat, (SHARPEST * this.pitch) / 2, ((1 - SHARPEST) * this.pitch) / 2);
  }

  // Profile of all teeth: [{angle, height}] around the gear.
  profile(facets) {
    const heights = Array.from({ length: facets + 1 }, (_, k) => this.bottom + ((this.top - this.bottom) * k) / facets);
    const right = heights.map((height) => ({ angle: -this.halfAngle(height), height }));
    const left = right.map(({ angle, height }) => ({ angle: -angle, height })).reverse();
    const tooth = [...right, ...left];
    const turned = (k) => tooth.map(({ angle, height }) => ({ angle: angle + k * this.pitch, height }));
    return Array.from({ length: this.teeth }, (_, k) => turned(k)).flat();
  }

  // Surface as a geometry with sharp edges. `before` and `after` are outlines [[radius, z]] of the body: from its start to the
  // toe, and from the heel to its end.
  surface(before, after) {
    const fitting = (most) => clamp(Math.round(MOST / this.teeth), 1, most);
    const profile = this.profile(fitting(FACETS.flank));
    const strips = this.twist === 0 ? 1 : fitting(FACETS.strip);
    const sections = Array.from({ length: strips + 1 }, (_, k) => this.width * (k / strips - 0.5));
    // a loop has one point for each point of the profile
    const loop = (turn, place) => profile.map(({ angle, height }) => {
      const [radius, z] = place(height);
      return [radius * Math.cos(angle + turn), radius * Math.sin(angle + turn), z];
    });
    const end = this.width / 2;
    const loops = [
      ...before.map((place) => loop(-end * this.twist, () => place)),
      ...sections.map((along) => loop(along * this.twist, (height) => this.point(along, height))),
      ...after.map((place) => loop(end * this.twist, () => place)),
    ];
    return creased(strung(loops));
  }
}

// Surface between consecutive loops of equally many points.
export function strung(loops) {
  const count = loops[0].length;
  const triangles = [];
  for (let row = 0; row + 1 < loops.length; row += 1) {
    for (let k = 0; k < count; k += 1) {
      const [here, next] = [row * count + k, row * count + ((k + 1) % count)];
      triangles.push(here, next, here + count, next, next + count, here + count);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(loops.flat(2)), 3));
  geometry.setIndex(new BufferAttribute(new Uint32Array(triangles), 1));
  return geometry;
}
