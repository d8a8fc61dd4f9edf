// Metal; on gears it lights up along the contact lines. All parts share one shader program, because each further
// program delays the first picture.
import { Color, DoubleSide, MeshStandardMaterial, Vector3, Vector4 } from "three";
import { paint } from "./paint.js";

const MOST = 10; // lines: two meshes of each of four planets, and three pairs instead of one of them
const X = new Vector3(1, 0, 0);

const dark = () => ({ value: Array.from({ length: MOST }, () => new Vector4(0, 0, 0, 0)) });

// Shared by all gears: directions of lines in the scene, with the intensity of their light in w, and their colours.
export class Glow {
  constructor() {
    this.lines = dark();
    this.noLines = dark();
    this.colours = { value: Array.from({ length: MOST }, () => new Color()) };
    this.width = { value: 5 };
  }

  // `lights`: [{line, share, colour}], all others are dark; the scene is turned by `held` about x relative to the
  // carrier.
  show(lights, held) {
    const turned = new Vector3();
    this.lines.value.forEach((place, i) => {
      const light = lights[i];
      if (!light) {
        place.w = 0;
        return;
      }
      turned.copy(light.line).applyAxisAngle(X, -held);
      place.set(turned.x, turned.y, turned.z, Math.min(light.share, 1));
      this.colours.value[i].copy(light.colour);
    });
  }

  // `isLit` for gears: light at the lines, but not on surfaces behind them.
  material(colour, roughness = 0.4, isLit = false) {
    const material = new MeshStandardMaterial({ color: colour, roughness, side: DoubleSide });
    const lines = isLit ? this.lines : this.noLines;
    paint(material, colour, null);
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, { glowLines: lines, glowWidth: this.width, glowColours: this.colours });
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
            if (glowLines[i].w == 0.0) continue;
            vec3 along = glowLines[i].xyz;
            float far = length(placed - max(dot(placed, along), 0.0) * along) / glowWidth;
            float share = glowLines[i].w * exp(-far * far);
            diffuseColor.rgb = mix(diffuseColor.rgb, glowColours[i], share);
            totalEmissiveRadiance = mix(totalEmissiveRadiance, 0.8 * glowColours[i], share);
          }`);
    };
    return material;
  }
}

