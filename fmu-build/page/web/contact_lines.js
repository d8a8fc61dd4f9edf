// Contact lines of tooth pairs, drawn over the teeth and coloured by pressure from toe to heel.
import { BufferAttribute, Color, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Vector3 } from "three";

const UP = new Vector3(0, 1, 0);
const MOST = 3;

export class ContactLines extends Group {
  constructor() {
    super();
    for (let i = 0; i < MOST; i += 1) {
      const geometry = new CylinderGeometry(1, 1, 1, 10, 2).translate(0, 0.5, 0);
      geometry.setAttribute("color", new BufferAttribute(new Float32Array(geometry.attributes.position.array.length), 3));
      const material = new MeshBasicMaterial({ vertexColors: true, toneMapped: false, depthTest: false, transparent: true });
      const line = new Mesh(geometry, material);
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
      mesh.quaternion.setFromUnitVectors(UP, direction);
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

  dispose() {
    for (const { geometry, material } of this.children) {
      geometry.dispose();
      material.dispose();
    }
  }
}
