// Parts around the gears, for orientation: half a case, cut open toward the eye, a flange for the ring gear, pins, washers and
// clutches.
import { CylinderGeometry, Group, LatheGeometry, Mesh, Shape, ShapeGeometry, Vector2 } from "three";
import { toCreasedNormals } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { paint } from "./steel.js";

const WALL = 5; // mm
const AIR = 3; // mm between moving parts and the case
const ROUND = 48;
export const COUPLING = 0.4; // thickness of a coupling per radius of its shaft
const CREASE = 0.45; // rad: edges stay sharp between faces at a larger angle
export const MARK = "#e0a030"; // colour of marks that make a rotation visible

// Names of parts as in colouring.js, with the colours of their metal.
const OWN = { case: "#8d949e", pins: "#6d747e", washers: "#b08d57", clutches: "#4b5058" };

export class Housing {
  // Reach of all gears from the apex, and backs of side gears and planets [mm]; `azimuth(i)` of planet i,
  // `metal(colour, roughness)`, and the `seat` of a ring gear that is drawn.
  constructor({ reach, back, planetBack, planets, azimuth, metal, seat }) {
    this.metals = Object.fromEntries(Object.entries(OWN).map(([name, colour]) => [name, metal(colour)]));
    const { metals } = this;
    this.shell = new Group();
    this.carrier = new Group();
    const [radius, half] = [reach + AIR, back + AIR];
    this.end = half + 3 * WALL;
    const profile = section(radius, half, shaftRadius(reach) + 2);
    metals.case.roughness = 0.6;
    const wall = new Mesh(new LatheGeometry(profile, ROUND, 0, Math.PI).rotateZ(-Math.PI / 2), metals.case);
    this.shell.add(wall, ...cuts(profile, metal));
    this.flange = seat ? flange(seat, caseRadius(seat.place, radius, half, shaftRadius(reach) + 2), metal)
      : flange(bareSeat(radius, half), 0.62 * radius, metal);
    this.carrier.add(this.flange);
    for (let i = 0; i < planets; i += 1) {
      const [length, inner] = [radius + WALL + 3, 0.16 * reach];
      const axle = new Group();
      const pin = new Mesh(new CylinderGeometry(inner, inner, length, ROUND).translate(0, length / 2, 0), metals.pins);
      axle.add(pin, ring(inner, 2.4 * inner, planetBack, 0.7 * AIR, metals.washers));
      axle.rotation.x = azimuth(i);
      this.carrier.add(axle);
    }
    // a washer, surrounded by a clutch pack, between each side gear and the case
    const [inner, middle, outer] = [shaftRadius(reach), 0.42 * reach, 0.62 * reach];
    for (const side of [1, -1]) {
      const pack = new Group();
      pack.add(ring(inner, middle, back, 0.7 * AIR, metals.washers));
      for (const k of [0, 1]) pack.add(ring(middle + 1, outer, back + 0.45 * AIR * k, 0.3 * AIR, metals.clutches));
      pack.rotation.z = (-side * Math.PI) / 2;
      this.carrier.add(pack);
      if (side > 0) this.left = pack;
    }
  }

  // Colours parts; a part without a colour has its own metal.
  paint(parts) {
    for (const [name, own] of Object.entries(OWN)) paint(this.metals[name], own, parts[name]);
  }

  // Shows or hides the parts behind the left side gear.
  showLeft(visible) {
    this.left.visible = visible;
  }

  // Shows or hides the case.
  show(visible) {
    this.shell.visible = visible;
    this.flange.visible = visible;
  }

  // Turns the open side of the case toward the eye.
  face(eye) {
    this.shell.rotation.x = Math.atan2(eye.z, eye.y);
  }

  // Turns with the carrier [rad].
  turn(carrier) {
    this.carrier.rotation.x = carrier;
  }

  get groups() {
    return [this.shell, this.carrier];
  }
}

export const creased = (geometry) => toCreasedNormals(geometry, CREASE);

export const shaftRadius = (reach) => 0.27 * reach;

// Outline of the case's wall in a plane through the axis: (distance from the axis, position along it).
function section(radius, half, hub) {
  const corner = 0.35 * radius;
  const side = (grown) => {
    const points = [new Vector2(hub, -half - 3 * WALL)];
    if (grown === 0) points.push(new Vector2(hub, -half));
    else points.push(new Vector2(hub + WALL, -half - 3 * WALL), new Vector2(hub + WALL, -half - grown));
    for (let k = 0; k <= 10; k += 1) {
      const angle = (Math.PI / 20) * k;
      const [out, along] = [Math.sin(angle), Math.cos(angle)].map((part) => (corner + grown) * part);
      points.push(new Vector2(radius - corner + out, -half + corner - along));
    }
    return [...points, ...points.map(({ x, y }) => new Vector2(x, -y)).reverse()];
  };
  const [inner, outer] = [side(0), side(WALL)];
  return [...inner, ...outer.reverse(), inner[0]];
}

// Faces of the cut, painted as on cut-away models.
function cuts(profile, metal) {
  return [1, -1].map((side) => {
    const shape = new Shape(profile.map(({ x, y }) => new Vector2(y, side * x)));
    const material = metal("#3f7f6c", 0.8);
    material.metalness = 0;
    return new Mesh(new ShapeGeometry(shape).rotateX(Math.PI / 2), material);
  });
}

// Outer radius of the case at a position along its axis.
function caseRadius(place, radius, half, hub) {
  const corner = 0.35 * radius;
  const past = Math.abs(place) - (half - corner);
  if (past <= 0) return radius + WALL;
  if (past >= corner + WALL) return hub + WALL;
  return radius - corner + Math.sqrt((corner + WALL) ** 2 - past ** 2);
}

// Seat on the left for a ring gear that is not drawn.
const bareSeat = (radius, half) => ({ side: 1, outer: radius + WALL + 3, place: half + WALL + 3, thick: 6 });

// Flange for the ring gear, with bolts that make the carrier's rotation visible. A seat is the outer radius of the flange, its
// position along the axis toward `side`, and its thickness.
function flange({ side, outer, place, thick }, inner, metal) {
  const group = new Group();
  if (inner >= outer) return group; // the ring gear is on the case
  const plate = ring(inner, outer, side * place - thick / 2, thick, metal("#78818d"), 2 * ROUND);
  plate.rotation.z = -Math.PI / 2;
  group.add(plate);
  // bolts need room between the case and the ring gear
  const far = outer - 5;
  if (far - 3 > inner) group.add(...bolts(10, 2.6, 2 * thick, 6, side * place, far, metal));
  return group;
}

// Disc along x with its middle at `place`.
export function disc(radius, thick, place, material, round = ROUND) {
  const mesh = new Mesh(new CylinderGeometry(radius, radius, thick, round).rotateZ(Math.PI / 2), material);
  mesh.position.x = place;
  return mesh;
}

// Circle of bolts around x; the first one is marked.
export function bolts(count, radius, length, round, place, far, metal) {
  return Array.from({ length: count }, (_, k) => {
    const angle = (2 * Math.PI * k) / count;
    const bolt = disc(radius, length, place, metal(k === 0 ? MARK : "#c9ced6"), round);
    bolt.position.y = far * Math.cos(angle);
    bolt.position.z = far * Math.sin(angle);
    return bolt;
  });
}

// Flat ring about y, starting at `place`.
export function ring(inner, outer, place, thick, material, round = ROUND) {
  const [low, high] = [place, place + thick];
  const outline = [[inner, low], [outer, low], [outer, high], [inner, high], [inner, low]].map(([r, y]) => new Vector2(r, y));
  return new Mesh(creased(new LatheGeometry(outline, round)), material);
}

// Disc with bolts at the end of a shaft along z, one of them marked.
export function coupling(place, radius, own, metal) {
  const group = new Group();
  // discs are along x
  group.rotation.y = -Math.PI / 2;
  group.position.z = place;
  group.add(disc(1.75 * radius, COUPLING * radius, 0, own), ...bolts(4, 0.22 * radius, 0.9 * radius, 6, 0, 1.35 * radius, metal));
  return group;
}

// Object whose position is a matrix.
export function placed(object) {
  object.matrixAutoUpdate = false;
  return object;
}

export function move(part, matrix) {
  part.matrix.copy(matrix);
  part.matrixWorldNeedsUpdate = true;
}
