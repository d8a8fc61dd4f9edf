// Surroundings mirrored by metal: a bright room with lamps, as an image. A modelled room would need separate shader
// programs, which take longer to compile than everything else here.
import { DataTexture, DataUtils, EquirectangularReflectionMapping, HalfFloatType, LinearFilter, PMREMGenerator, RGBAFormat } from "three";

const [WIDE, HIGH] = [128, 64];
// ground, horizon, ceiling: brightness
const FLOOR = 0.1;
const HORIZON = 0.3;
const CEILING = 0.5;
// lamps: azimuth and height of the middle, half widths [deg], brightness
const LAMPS = [
  [-60, 62, 34, 12, 6], [70, 58, 26, 12, 5.5], [170, 55, 40, 10, 6], [-150, 12, 10, 30, 3.5], [20, 14, 9, 26, 3], [110, 8, 12, 22, 2.5],
];

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
const edge = (far) => Math.min(Math.max((1.15 - far) / 0.3, 0), 1);
