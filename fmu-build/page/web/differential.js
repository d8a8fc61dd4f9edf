// The differential in the scene: gears from the library's surfaces at their positions, the half-shafts, the final drive,
// arrows, and light at the meshes.
import {
  BufferAttribute, BufferGeometry, Color, ConeGeometry, CylinderGeometry, Group, Matrix4, Mesh, MeshBasicMaterial, Vector3,
} from "three";
import { hasPairs, pairs } from "./contact.js";
import { FinalDrive } from "./drive_parts.js";
import { HalfShaft } from "./half_shafts.js";
import { creased, Housing, move, placed } from "./housing.js";
import { Glow, paint } from "./steel.js";
import { clamp } from "./table.js";

const SIDES = [["left", 1], ["right", -1]];
const MOST = 3; // contact lines
const ROUND = 20;
const ARROW = "#ff3b2f";
const GEAR = 0.36; // roughness
const OWN = { planet: "#d99a35", side: "#4d7cb8", grey: "#8b929b" };
const [X, Y] = [new Vector3(1, 0, 0), new Vector3(0, 1, 0)];

const aboutX = (angle) => new Matrix4().makeRotationX(angle);
const aboutZ = (angle) => new Matrix4().makeRotationZ(angle);
const axes = (x, y, z) => new Matrix4().makeBasis(new Vector3(...x), new Vector3(...y), new Vector3(...z));

// Columns: axes of a gear's own frame (z from apex to heel, tooth 0 at x) in the assembly.
const LEFT = axes([0, 1, 0], [0, 0, 1], [1, 0, 0]);
const RIGHT = axes([0, 1, 0], [0, 0, -1], [-1, 0, 0]);
const PLANET = axes([1, 0, 0], [0, 0, -1], [0, 1, 0]);

// Positions of the gears: x is the carrier's axis, the left side gear points along +x, and planet i along y turned
// about x.
export class Assembly {
  // Teeth and planets are counts; `planet` are the planets' cones, and the pressure angle is in rad.
  constructor({ planetTeeth, sideTeeth, planets, pressureAngle, planet }) {
    Object.assign(this, { planetTeeth, sideTeeth, planets, pressureAngle, cones: planet });
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
    const outward = Y.clone().applyAxisAngle(X, carrier + this.azimuth(planet));
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
    const apart = Math.acos(clamp(Math.cos(polar) / most, -1, 1));
    // contact is outside the planet's base circle, which the great circle touches in the middle
    const arc = middle + apart;
    return line.multiplyScalar(Math.cos(arc)).addScaledVector(force, Math.sin(arc));
  }
}

// Parts that show what is inside the gears, and are therefore drawn over everything. They point along y.
const onTop = (options) => new MeshBasicMaterial({ ...options, toneMapped: false, depthTest: false, transparent: true });
const pointing = (geometry) => geometry.translate(0, 0.5, 0);

class Arrow extends Group {
  constructor() {
    super();
    const material = onTop({ color: ARROW, opacity: 0.92 });
    this.body = new Mesh(pointing(new CylinderGeometry(1, 1, 1, ROUND)), material);
    this.head = new Mesh(pointing(new ConeGeometry(1, 1, ROUND)), material);
    for (const part of [this.body, this.head]) part.renderOrder = 10;
    this.add(this.body, this.head);
  }

  // Points from its position along `direction`; lengths in mm, with the maximum radius `thick`.
  draw(direction, length, thick) {
    const head = Math.min(4 * thick, 0.5 * length);
    const radius = Math.min(thick, 0.12 * length);
    this.quaternion.setFromUnitVectors(Y, direction);
    this.body.scale.set(radius, length - head, radius);
    this.head.scale.set(2 * radius, head, 2 * radius);
    this.head.position.y = length - head;
  }
}

// Contact lines of tooth pairs, coloured by pressure from toe to heel.
class ContactLines extends Group {
  constructor() {
    super();
    for (let i = 0; i < MOST; i += 1) {
      const geometry = pointing(new CylinderGeometry(1, 1, 1, 10, 2));
      geometry.setAttribute("color", new BufferAttribute(new Float32Array(geometry.attributes.position.array.length), 3));
      const line = new Mesh(geometry, onTop({ vertexColors: true }));
      line.renderOrder = 8;
      this.add(line);
    }
  }

  // `lines`: [{direction, colours: [toe, middle, heel]}] from the inner to the outer cone distance; lengths in mm.
  show(lines, { inner, outer }, thick) {
    this.children.forEach((mesh, i) => {
      mesh.visible = i < lines.length;
      if (!mesh.visible) return;
      const { direction, colours } = lines[i];
      mesh.quaternion.setFromUnitVectors(Y, direction);
      mesh.position.copy(direction).multiplyScalar(inner);
      mesh.scale.set(thick, outer - inner, thick);
      this.colour(mesh.geometry, colours);
    });
  }

  colour({ attributes: { position, color } }, colours) {
    const own = new Color();
    for (let k = 0; k < position.count; k += 1) {
      own.copy(colours[Math.round(2 * position.getY(k))]);
      color.setXYZ(k, own.r, own.g, own.b);
    }
    color.needsUpdate = true;
  }
}

export class Differential {
  constructor() {
    this.group = new Group();
    this.still = new Group(); // parts that do not turn with the gears: the cut case
    this.glow = new Glow();
    this.arrowLength = 0.7; // arrow of the largest force, relative to the reach of the gears
    this.side = this.glow.material(OWN.side, GEAR, true);
    this.planet = this.glow.material(OWN.planet, GEAR, true);
    // the left side gear can be transparent to show the planet's flanks behind it
    this.clear = this.glow.material(OWN.side, GEAR, true);
    Object.assign(this.clear, { transparent: true, opacity: 0.2, depthWrite: false, forceSinglePass: true });
    this.contactLines = new ContactLines();
    this.contactLines.visible = false;
    // one object of each kind of material, so that their programs can be compiled before there are gears
    this.group.add(fixed(new BufferGeometry(), this.side), new Arrow());
  }

  // Replaces the gears: surfaces of planet and side gear, and the geometry that determines their positions. Its `drive` is
  // the final drive, or null, and `clutches` are those of `drawnClutches`.
  build([planet, side], geometry) {
    for (const gear of this.gears ?? []) gear.geometry.dispose();
    const shafts = (this.halfShafts ?? []).map(({ group }) => group);
    const before = [...(this.housing?.groups ?? []), ...shafts, ...(this.arrows ?? []).flat(), this.drive?.group ?? []].flat();
    for (const group of before) group.traverse(dispose);
    this.group.clear();
    this.still.clear();
    const assembly = new Assembly({ ...geometry, planet: planet.cones });
    this.assembly = assembly;
    const [planetShape, sideShape] = [shape(planet), shape(side)];
    this.reach = Math.max(farthest(planet), farthest(side));
    this.left = fixed(sideShape, this.isClear ? this.clear : this.side);
    this.right = fixed(sideShape, this.side);
    this.planets = Array.from({ length: assembly.planets }, () => fixed(planetShape, this.planet));
    this.gears = [this.left, this.right, ...this.planets];
    const metal = (colour, roughness) => this.glow.material(colour, roughness);
    this.drive = geometry.drive ? new FinalDrive(geometry.drive, metal) : null;
    this.housing = new Housing({
      reach: this.reach, back: highest(side), planetBack: highest(planet), planets: assembly.planets,
      azimuth: (i) => assembly.azimuth(i), metal, seat: this.drive?.seat,
    });
    const begin = 0.62 * highest(side);
    const start = this.housing.end;
    this.end = Math.max(highest(side) + 0.75 * this.reach, ...geometry.clutches.map((own) => start + HalfShaft.length(this.reach, own)));
    this.halfShafts = geometry.clutches.map((own, k) => (
      new HalfShaft({ ...own, side: SIDES[k][1], reach: this.reach, begin, start, end: this.end, metal })));
    this.arrows = this.planets.map(() => SIDES.map(() => new Arrow()));
    this.driveArrow = new Arrow();
    this.glow.width.value = 0.11 * this.reach;
    this.group.add(...this.gears, this.housing.carrier, ...this.halfShafts.map(({ group }) => group), ...this.arrows.flat(),
      this.contactLines);
    if (this.drive) this.drive.group.add(this.driveArrow);
    if (this.drive) this.group.add(this.drive.group);
    this.still.add(this.housing.shell);
    this.housing.show(this.withCase ?? true);
    this.showDrive(this.withDrive ?? true);
    this.showLeft(!this.isClear);
  }

  // Draws the time of the last call of `record.seek`. `largest` is the force of an arrow of full length [N]; `colours`
  // come from a mode in colouring.js. The scene is turned by `held` relative to the carrier; `pressed(pressure)` is the
  // colour of a pressure [Pa].
  pose(record, largest, colours, held, pressed) {
    if (!this.gears) return;
    const { assembly } = this;
    const read = (name) => record.value(name);
    const angle = (name) => read(`${name}.angle`);
    move(this.left, assembly.left(angle("left")));
    move(this.right, assembly.right(angle("right")));
    this.planets.forEach((planet, i) => move(planet, assembly.planet(i, angle("carrier"), read(`planet[${i + 1}].spin_angle`))));
    this.housing.turn(angle("carrier"));
    for (const shaft of this.halfShafts) shaft.turn(record, angle("carrier"));
    if (this.drive) {
      this.drive.turn({ carrier: angle("carrier"), pinion: angle("pinion"), propeller: angle("propeller") });
      const force = this.drive.place.force(read);
      const share = largest > 0 ? force.length() / largest : 0;
      this.load(this.driveArrow, this.drive.place.pitchPoint, force.normalize(), share);
    }
    const lights = [];
    this.planets.forEach((_, i) => SIDES.forEach(([name, side], k) => {
      const share = largest > 0 ? read(`planet[${i + 1}].${name}_normal_force`) / largest : 0;
      const sense = read(`${name}.tangential_force`) < 0 ? -1 : 1;
      const mesh = assembly.mesh(i, side, angle("carrier"), sense);
      this.load(this.arrows[i][k], mesh.line.clone().multiplyScalar(assembly.cones.outer), mesh.force, share);
      if (i > 0 || side < 0 || !hasPairs(record)) lights.push({ line: mesh.line, ...colours.mesh(share) });
    }));
    const touching = pairs((name) => record.point(name))
      .map((pair) => ({ pair, direction: this.contact(pair, angle("carrier")) }));
    for (const { pair, direction } of touching) lights.push({ line: direction, ...colours.pair(pair) });
    if (this.isClear) {
      const lines = touching.map(({ pair, direction }) => ({ direction, colours: pair.pressures.map(pressed) }));
      this.contactLines.show(lines, assembly.cones, 0.012 * this.reach);
    }
    this.glow.show(lights, held);
    this.group.rotation.x = -held;
    this.paint(colours);
  }

  // Contact line of a pair of planet 1 with the left side gear.
  contact({ force, height }, carrier) {
    const { pitch, mean } = this.assembly.cones;
    return this.assembly.contact(0, 1, carrier, Math.sign(force), pitch + (1e3 * height) / mean);
  }

  paint(colours) {
    const { planet, side, parts, isGrey } = colours;
    paint(this.planet, isGrey ? OWN.grey : OWN.planet, planet);
    for (const material of [this.side, this.clear]) paint(material, isGrey ? OWN.grey : OWN.side, side);
    this.housing.paint(parts);
    for (const shaft of this.halfShafts) shaft.paint(colours);
    this.drive?.paint(parts, isGrey);
  }

  // Shows the flanks of the planets through the left side gear.
  showThrough(isClear) {
    this.isClear = isClear;
    this.contactLines.visible = isClear;
    if (!this.gears) return;
    this.showLeft(!isClear);
    this.left.material = isClear ? this.clear : this.side;
  }

  // Shows or hides the parts behind the left side gear.
  showLeft(visible) {
    this.housing.showLeft(visible);
    this.halfShafts[0].group.visible = visible;
  }

  showCase(visible) {
    this.withCase = visible;
    this.housing?.show(visible);
  }

  // Shows or hides the final drive, which would cover the gears in views of one mesh.
  showDrive(visible) {
    this.withDrive = visible;
    if (this.drive) this.drive.group.visible = visible;
  }

  // Draws an arrow at a position, as long as its share of the largest force.
  load(pointer, position, force, share) {
    const length = this.arrowLength * this.reach * share;
    pointer.visible = share > 0.01;
    pointer.position.copy(position);
    pointer.draw(force, Math.max(length, 0.01), 0.045 * this.arrowLength * this.reach);
  }
}

const fixed = (geometry, material) => placed(new Mesh(geometry, material));

function shape({ vertices, triangles }) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(vertices, 3));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  return creased(geometry);
}

function dispose({ geometry, material }) {
  geometry?.dispose();
  material?.dispose();
}

const triples = (numbers, of) => {
  let most = 0;
  for (let k = 0; k < numbers.length; k += 3) most = Math.max(most, of(numbers[k], numbers[k + 1], numbers[k + 2]));
  return most;
};
const farthest = ({ vertices }) => triples(vertices, Math.hypot);
const highest = ({ vertices }) => triples(vertices, (x, y, z) => z);
