// Common colour scale from small to large for gears and legend.
import { Color } from "three";

// from dark blue through green to red; in greyscale the order is preserved, except for the last step
const STOPS = ["#2b4f9e", "#2a8fb0", "#3fae6b", "#d9c431", "#ee7b22", "#d3202a"].map((colour) => new Color(colour));

// Clamps a fraction to 0…1; 0 if it is NaN, such as relative to a largest value that is not known yet.
const within = (share) => (share > 0 ? Math.min(share, 1) : 0);

// Colour of a fraction from 0 to 1; larger values have the last colour.
export function scaled(share) {
  const place = within(share) * (STOPS.length - 1);
  const below = Math.min(Math.floor(place), STOPS.length - 2);
  return STOPS[below].clone().lerp(STOPS[below + 1], place - below);
}

export const css = (colour) => `#${colour.getHexString()}`;

// The colour as text for a canvas, from a palette because a canvas needs many.
const palette = Array.from({ length: 256 }, (_, k) => css(scaled(k / 255)));
export const shade = (share) => palette[Math.round(255 * within(share))];

export const gradient = () => `linear-gradient(to right, ${STOPS.map(css).join(", ")})`;
