// Metal that lights up along the lines of contact.
import { Color, MeshStandardMaterial, Vector3, Vector4 } from "three";

const MOST = 10; // lines: two meshes of each of four planets, and three pairs in place of one of them
const X = new Vector3(1, 0, 0);

// Shared by all gears: directions of lines in the scene with the strength of their light in w, and their colours.
export class Glow {
  constructor() {
    this.lines = { value: Array.from({ length: MOST }, () => new Vector4()) };
    this.colours = { value: Array.from({ length: MOST }, () => new Color()) };
    this.width = { value: 5 };
  }

  // `lights`: [{line, share, colour}], the rest is dark; the scene is turned by `held` about x against the carrier.
  show(lights, held) {
    const turned = new Vector3();
    this.lines.value.forEach((place, i) => {
      const light = lights[i];
      if (!light) {
        place.w = 0;
        return;
      }
      turned.copy(light.line).applyAxisAngle(X, -held);
      place.set(turned.x, turned.y, turned.z, 0.9 * Math.min(light.share, 1));
      this.colours.value[i].copy(light.colour);
    });
  }

  material(colour) {
    const material = new MeshStandardMaterial({ color: colour, roughness: 0.36 });
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, { glowLines: this.lines, glowWidth: this.width, glowColours: this.colours });
      shader.vertexShader = shader.vertexShader
        .replace("#include <common>", "#include <common>\nvarying vec3 placed;")
        .replace("#include <begin_vertex>", "#include <begin_vertex>\nplaced = (modelMatrix * vec4(position, 1.0)).xyz;");
      shader.fragmentShader = shader.fragmentShader
        .replace("#include <common>", `#include <common>
          varying vec3 placed;
          uniform vec4 glowLines[${MOST}];
          uniform float glowWidth;
          uniform vec3 glowColours[${MOST}];`)
        .replace("#include <emissivemap_fragment>", `#include <emissivemap_fragment>
          for (int i = 0; i < ${MOST}; i += 1) {
            vec3 along = glowLines[i].xyz;
            float far = length(placed - max(dot(placed, along), 0.0) * along) / glowWidth;
            totalEmissiveRadiance += glowLines[i].w * glowColours[i] * exp(-far * far);
          }`);
    };
    return material;
  }
}

