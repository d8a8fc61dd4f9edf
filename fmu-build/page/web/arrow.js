// Solid arrow, drawn over everything so that forces inside the gears are visible.
import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Vector3 } from "three";

const UP = new Vector3(0, 1, 0);
const ROUND = 20;

export class Arrow extends Group {
  constructor(colour) {
    super();
    const material = new MeshBasicMaterial({
      color: colour, depthTest: false, transparent: true, opacity: 0.92, toneMapped: false,
    });
    this.body = new Mesh(new CylinderGeometry(1, 1, 1, ROUND).translate(0, 0.5, 0), material);
    this.head = new Mesh(new ConeGeometry(1, 1, ROUND).translate(0, 0.5, 0), material);
    for (const part of [this.body, this.head]) part.renderOrder = 10;
    this.add(this.body, this.head);
  }

  // Points from its position along `direction`; lengths in mm, with the maximum radius `thick`.
  draw(direction, length, thick) {
    const head = Math.min(4 * thick, 0.5 * length);
    const radius = Math.min(thick, 0.12 * length);
    this.quaternion.setFromUnitVectors(UP, direction);
    this.body.scale.set(radius, length - head, radius);
    this.head.scale.set(2 * radius, head, 2 * radius);
    this.head.position.y = length - head;
  }

  dispose() {
    for (const part of [this.body, this.head]) part.geometry.dispose();
    this.body.material.dispose();
  }
}
