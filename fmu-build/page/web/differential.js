// The differential in the scene: gears from the library's surfaces, what holds them, arrows and light at the meshes.
import { BufferAttribute, BufferGeometry, Group, Mesh, Vector3 } from "three";
import { toCreasedNormals } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { Arrow } from "./arrow.js";
import { Housing } from "./housing.js";
import { Glow } from "./steel.js";

const CREASE = 0.45; // rad: faces that meet at more keep an edge
const SIDES = [["left", 1], ["right", -1]];
const ARROW = "#ff3b2f";

export class Differential {
  constructor() {
    this.group = new Group();
    this.still = new Group(); // what does not turn with the gears: the cut case
    this.glow = new Glow();
    this.arrowLength = 0.7; // of the largest force, in reaches of the gears
    this.steel = this.glow.material("#4d7cb8");
    this.brass = this.glow.material("#d99a35");
  }

  // New gears: surfaces of planet and side gear, and the assembly they stand in.
  build([planet, side], assembly) {
    for (const gear of this.gears ?? []) gear.geometry.dispose();
    this.housing?.dispose();
    for (const pointer of this.arrows?.flat() ?? []) pointer.dispose();
    this.group.clear();
    this.still.clear();
    this.assembly = assembly;
    const [planetShape, sideShape] = [shape(planet), shape(side)];
    this.reach = Math.max(farthest(planet), farthest(side));
    this.left = fixed(sideShape, this.steel);
    this.right = fixed(sideShape, this.steel);
    this.planets = Array.from({ length: assembly.planets }, () => fixed(planetShape, this.brass));
    this.gears = [this.left, this.right, ...this.planets];
    this.housing = new Housing({
      reach: this.reach, back: highest(side), planets: assembly.planets, azimuth: (i) => assembly.azimuth(i),
    });
    this.arrows = this.planets.map(() => SIDES.map(() => new Arrow(ARROW)));
    this.glow.width.value = 0.11 * this.reach;
    this.group.add(...this.gears, this.housing.carrier, ...this.housing.shafts, ...this.arrows.flat());
    this.still.add(this.housing.shell);
    this.housing.show(this.withCase ?? true);
  }

  // `read(name)` gives values at the time of the picture; `largest` is the force [N] of a whole arrow.
  pose(read, largest) {
    if (!this.gears) return;
    const { assembly } = this;
    const angle = (name) => read(`${name}.angle`);
    place(this.left, assembly.left(angle("left")));
    place(this.right, assembly.right(angle("right")));
    this.planets.forEach((planet, i) => place(planet, assembly.planet(i, angle("carrier"), read(`planet[${i + 1}].spin_angle`))));
    this.housing.turn(angle("carrier"), angle("left") - read("left.twist"), angle("right") - read("right.twist"));
    this.planets.forEach((_, i) => SIDES.forEach(([name, side], k) => {
      const share = largest > 0 ? read(`planet[${i + 1}].${name}_normal_force`) / largest : 0;
      const sense = read(`${name}.tangential_force`) < 0 ? -1 : 1;
      const mesh = assembly.mesh(i, side, angle("carrier"), sense);
      this.load(this.arrows[i][k], mesh, share);
      this.glow.lines.value[2 * i + k].set(mesh.line.x, mesh.line.y, mesh.line.z, 0.9 * Math.min(share, 1));
    }));
    for (let k = 2 * this.planets.length; k < this.glow.lines.value.length; k += 1) this.glow.lines.value[k].w = 0;
  }

  // Light is placed in the scene, which may turn against the carrier by `held`.
  hold(held) {
    this.group.rotation.x = -held;
    for (const line of this.glow.lines.value) {
      const turned = new Vector3(line.x, line.y, line.z).applyAxisAngle(new Vector3(1, 0, 0), -held);
      line.set(turned.x, turned.y, turned.z, line.w);
    }
  }

  showCase(visible) {
    this.withCase = visible;
    this.housing?.show(visible);
  }

  load(pointer, { line, force }, share) {
    const length = this.arrowLength * this.reach * share;
    pointer.visible = share > 0.01;
    pointer.position.copy(line).multiplyScalar(this.assembly.outerCone);
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
