// Metal that lights up along the pitch lines of loaded meshes.
import { Color, MeshStandardMaterial, Vector4 } from "three";

export const MOST = 8; // meshes: four planets, two side gears

// Shared by all gears: direction of each pitch line in the scene, and the load's share of the largest in w.
export class Glow {
  constructor() {
    this.lines = { value: Array.from({ length: MOST }, () => new Vector4()) };
    this.width = { value: 5 };
    this.colour = { value: new Color("#ff5a1f") };
  }

  material(colour) {
    const material = new MeshStandardMaterial({ color: colour, metalness: 0.75, roughness: 0.36 });
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, { glowLines: this.lines, glowWidth: this.width, glowColour: this.colour });
      shader.vertexShader = shader.vertexShader
        .replace("#include <common>", "#include <common>\nvarying vec3 placed;")
        .replace("#include <begin_vertex>", "#include <begin_vertex>\nplaced = (modelMatrix * vec4(position, 1.0)).xyz;");
      shader.fragmentShader = shader.fragmentShader
        .replace("#include <common>", `#include <common>
          varying vec3 placed;
          uniform vec4 glowLines[${MOST}];
          uniform float glowWidth;
          uniform vec3 glowColour;`)
        .replace("#include <emissivemap_fragment>", `#include <emissivemap_fragment>
          for (int i = 0; i < ${MOST}; i += 1) {
            vec3 along = glowLines[i].xyz;
            float far = length(placed - max(dot(placed, along), 0.0) * along) / glowWidth;
            totalEmissiveRadiance += glowLines[i].w * glowColour * exp(-far * far);
          }`);
    };
    return material;
  }
}
