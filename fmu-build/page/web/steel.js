// Metal: its paint, the light along contact lines of gears, and the surroundings that it mirrors. All parts share one
// shader program, because each further program delays the first picture.
import {
  Color, DataTexture, DataUtils, DoubleSide, EquirectangularReflectionMapping, HalfFloatType, LinearFilter, MeshStandardMaterial,
  PMREMGenerator, RGBAFormat, Vector3, Vector4,
} from "three";
import { clamp } from "./table.js";

const MIRROR = { own: 0.72, painted: 0.15 };
const SHINE = 0.16;
const LIT = 0.7; // fraction of the colour: light makes it brighter than in the legend
const MOST = 10; // lines: two meshes of each of four planets, and three pairs instead of one of them
const X = new Vector3(1, 0, 0);

// the mirrored image: its size in pixels, and the brightness of ground, horizon and ceiling
const [WIDE, HIGH] = [128, 64];
const [FLOOR, HORIZON, CEILING] = [0.1, 0.3, 0.5];
// lamps: azimuth and height of the middle, half widths [deg], brightness
const LAMPS = [
  [-60, 62, 34, 12, 6], [70, 58, 26, 12, 5.5], [170, 55, 40, 10, 6], [-150, 12, 10, 30, 3.5], [20, 14, 9, 26, 3], [110, 8, 12, 22, 2.5],
];

// Paints metal in a colour that represents a value, or gives it its own colour. Painted parts emit a little light and
// mirror less, so that their colour matches the legend.
export function paint(material, own, colour) {
  material.color.set(colour ?? own).multiplyScalar(colour ? LIT : 1);
  material.emissive.set(colour ?? 0).multiplyScalar(SHINE);
  material.metalness = colour ? MIRROR.painted : MIRROR.own;
}

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
    paint(material, colour);
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

// Surroundings mirrored by metal: a bright room with lamps, as an image. A modelled room would need separate shader
// programs, which take longer to compile than everything else here.
export function studio(renderer) {
  const numbers = new Uint16Array(4 * WIDE * HIGH);
  for (let j = 0; j < HIGH; j += 1) {
    const height = 180 * ((j + 0.5) / HIGH - 0.5);
    for (let i = 0; i < WIDE; i += 1) {
      const light = brightness(360 * ((i + 0.5) / WIDE - 0.5), height);
      numbers.set([light, light, 1.03 * light, 1].map(DataUtils.toHalfFloat), 4 * (j * WIDE + i));
    }
  }
  const texture = new DataTexture(numbers, WIDE, HIGH, RGBAFormat, HalfFloatType);
  Object.assign(texture, { mapping: EquirectangularReflectionMapping, magFilter: LinearFilter, minFilter: LinearFilter });
  texture.needsUpdate = true;
  const light = new PMREMGenerator(renderer);
  const made = light.fromEquirectangular(texture).texture;
  texture.dispose();
  return made;
}

function brightness(azimuth, height) {
  const share = Math.sin((height * Math.PI) / 180);
  const room = share < 0 ? HORIZON + share * (HORIZON - FLOOR) : HORIZON + share * (CEILING - HORIZON);
  return LAMPS.reduce((sum, [at, high, wide, tall, light]) => {
    const aside = Math.abs(((azimuth - at + 540) % 360) - 180);
    return sum + light * edge(aside / wide) * edge(Math.abs(height - high) / tall);
  }, room);
}

// 1 inside, 0 outside, with a soft transition.
const edge = (far) => clamp((1.15 - far) / 0.3, 0, 1);
