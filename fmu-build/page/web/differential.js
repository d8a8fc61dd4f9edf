// The differential in the scene: gears from the library's surfaces, their housing, arrows and light at the meshes.
import { BufferAttribute, BufferGeometry, Group, Mesh, Vector3 } from "three";
import { toCreasedNormals } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { Arrow } from "./arrow.js";
import { ContactLines } from "./contact_lines.js";
import { Housing } from "./housing.js";
import { paint } from "./paint.js";
import { hasPairs, pairs } from "./pairs.js";
import { Glow } from "./steel.js";

const CREASE = 0.45; // rad: edges stay sharp between faces at a larger angle
const SIDES = [["left", 1], ["right", -1]];
const ARROW = "#ff3b2f";
const GEAR = 0.36; // roughness
const OWN = { planet: "#d99a35", side: "#4d7cb8", grey: "#8b929b" };

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
    this.group.add(fixed(new BufferGeometry(), this.side), new Arrow(ARROW));
  }

  // Replaces the gears: surfaces of planet and side gear, and their assembly.
  build([planet, side], assembly) {
    for (const gear of this.gears ?? []) gear.geometry.dispose();
    this.housing?.dispose();
    for (const pointer of this.arrows?.flat() ?? []) pointer.dispose();
    this.group.clear();
    this.still.clear();
    this.assembly = assembly;
    const [planetShape, sideShape] = [shape(planet), shape(side)];
    this.reach = Math.max(farthest(planet), farthest(side));
    this.left = fixed(sideShape, this.isClear ? this.clear : this.side);
    this.right = fixed(sideShape, this.side);
    this.planets = Array.from({ length: assembly.planets }, () => fixed(planetShape, this.planet));
    this.gears = [this.left, this.right, ...this.planets];
    this.housing = new Housing({
      reach: this.reach, back: highest(side), planetBack: highest(planet), planets: assembly.planets,
      azimuth: (i) => assembly.azimuth(i), metal: (colour, roughness) => this.glow.material(colour, roughness),
    });
    this.arrows = this.planets.map(() => SIDES.map(() => new Arrow(ARROW)));
    this.glow.width.value = 0.11 * this.reach;
    this.group.add(...this.gears, this.housing.carrier, ...this.housing.shafts, ...this.arrows.flat(), this.contactLines);
    this.still.add(this.housing.shell);
    this.housing.show(this.withCase ?? true);
    this.housing.showLeft(!this.isClear);
  }

  // Draws the time of the last call of `record.seek`. `largest` is the force of an arrow of full length [N]; `colours`
  // come from colouring.js. The scene is turned by `held` relative to the carrier; `pressed(pressure)` is the colour of
  // a pressure [Pa].
  pose(record, largest, colours, held, pressed) {
    if (!this.gears) return;
    const { assembly } = this;
    const read = (name) => record.value(name);
    const angle = (name) => read(`${name}.angle`);
    place(this.left, assembly.left(angle("left")));
    place(this.right, assembly.right(angle("right")));
    this.planets.forEach((planet, i) => place(planet, assembly.planet(i, angle("carrier"), read(`planet[${i + 1}].spin_angle`))));
    this.housing.turn(angle("carrier"), angle("left") - read("left.twist"), angle("right") - read("right.twist"));
    const lights = [];
    this.planets.forEach((_, i) => SIDES.forEach(([name, side], k) => {
      const share = largest > 0 ? read(`planet[${i + 1}].${name}_normal_force`) / largest : 0;
      const sense = read(`${name}.tangential_force`) < 0 ? -1 : 1;
      const mesh = assembly.mesh(i, side, angle("carrier"), sense);
      this.load(this.arrows[i][k], mesh, share);
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

  paint({ planet, side, parts, isGrey }) {
    paint(this.planet, isGrey ? OWN.grey : OWN.planet, planet);
    for (const material of [this.side, this.clear]) paint(material, isGrey ? OWN.grey : OWN.side, side);
    this.housing.paint(parts);
  }

  // Shows the flanks of the planets through the left side gear.
  showThrough(isClear) {
    this.isClear = isClear;
    this.contactLines.visible = isClear;
    this.housing?.showLeft(!isClear);
    if (this.left) this.left.material = isClear ? this.clear : this.side;
  }

  showCase(visible) {
    this.withCase = visible;
    this.housing?.show(visible);
  }

  load(pointer, { line, force }, share) {
    const length = this.arrowLength * this.reach * share;
    pointer.visible = share > 0.01;
    pointer.position.copy(line).multiplyScalar(this.assembly.cones.outer);
    pointer.draw(force, Math.max(length, 0.01), 0.045 * this.arrowLength * this.reach);
  }
}

function fixed(geometry, material) {
  const mesh = new Mesh(geometry, material);
  mesh.matrixAutoUpdate = false;
  return mesh;
}

function place(mesh, matrix) {
  mesh.matrix.copy(matrix);
  mesh.matrixWorldNeedsUpdate = true;
}

function shape({ vertices, triangles }) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(vertices, 3));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  return toCreasedNormals(geometry, CREASE);
}

const triples = (numbers, of) => {
  let most = 0;
  for (let k = 0; k < numbers.length; k += 3) most = Math.max(most, of(numbers[k], numbers[k + 1], numbers[k + 2]));
  return most;
};
const farthest = ({ vertices }) => triples(vertices, Math.hypot);
const highest = ({ vertices }) => triples(vertices, (x, y, z) => z);
