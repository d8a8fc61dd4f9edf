// One scale of colours from little to much, for the gears and for the legend alike.
import { Color } from "three";

// from dark blue through green to red: order is kept where colours are seen as greys, but for the last step
const STOPS = ["#2b4f9e", "#2a8fb0", "#3fae6b", "#d9c431", "#ee7b22", "#d3202a"].map((colour) => new Color(colour));

// A share within 0 to 1; 0 where there is none, as of a largest value that is not known yet.
const within = (share) => (share > 0 ? Math.min(share, 1) : 0);

// Colour of a share from 0 to 1; more than 1 is the last one.
export function scaled(share) {
  const place = within(share) * (STOPS.length - 1);
  const below = Math.min(Math.floor(place), STOPS.length - 2);
  return STOPS[below].clone().lerp(STOPS[below + 1], place - below);
}

export const css = (colour) => `#${colour.getHexString()}`;

// The same as text for a canvas, which takes many: out of a palette.
const palette = Array.from({ length: 256 }, (_, k) => css(scaled(k / 255)));
export const shade = (share) => palette[Math.round(255 * within(share))];

export const gradient = () => `linear-gradient(to right, ${STOPS.map(css).join(", ")})`;
