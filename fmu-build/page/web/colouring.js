// Meaning of colours: load, stress or heat. A mode lists the outputs that it needs and, for the time of the picture,
// which parts are lit or coloured. All other parts are plain metal.
import * as heat from "./colour_heat.js";
import * as load from "./colour_load.js";
import * as stress from "./colour_stress.js";

export const MODES = { load, stress, heat };

// For the time of the last call of `record.seek`: {mesh, pair, planet, side, parts, legend}.
//   mesh(share)  light of a mesh with this share of the largest force: {share, colour}, share 0 for none
//   pair(pair)   light of a tooth pair of planet 1 with the left side gear
//   planet, side colours of the gears, null for their metal
//   parts        colours of washers, clutches, pins, shafts, case and brakes by name
//   legend       {lines: [{text, colour}], scale: {least, most} or null, off: {text, name} or null}
export const coloured = (mode, context) => MODES[mode].colours(context);
