// One scale of colours from little to much, for the gears and for the legend alike.
import { Color } from "three";

// from dark blue through green to red: order is kept where colours are seen as greys, but for the last step
const STOPS = ["#2b4f9e", "#2a8fb0", "#3fae6b", "#d9c431", "#ee7b22", "#d3202a"].map((colour) => new Color(colour));

// Colour of a share from 0 to 1; more than 1 is the last one.
export function scaled(share) {
  const place = Math.min(Math.max(share, 0), 1) * (STOPS.length - 1);
  const below = Math.min(Math.floor(place), STOPS.length - 2);
  return STOPS[below].clone().lerp(STOPS[below + 1], place - below);
}

export const css = (colour) => `#${colour.getHexString()}`;

// The same as text for a canvas, which takes many: out of a palette.
const palette = Array.from({ length: 256 }, (_, k) => css(scaled(k / 255)));
export const shade = (share) => palette[Math.round(255 * Math.min(Math.max(share, 0), 1))];

export const gradient = () => `linear-gradient(to right, ${STOPS.map(css).join(", ")})`;
