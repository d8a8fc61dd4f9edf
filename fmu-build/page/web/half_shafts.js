// Half-shafts in the scene, with the parts between side gear and wheel: clutches on command, and dog clutches.
//
// From the case to the wheel, these are: the pack of a clutch on command, in which plates of the side gear alternate with
// plates of the clutch's shaft; the toothed ring on the side gear; the ring that slides on the half-shaft; the flange of the
// wheel. Lengths are in mm, angles in rad.
import { BoxGeometry, Color, Group, Mesh, Vector3 } from "three";
import { bolts, creased, disc, MARK, ring, shaftRadius } from "./housing.js";
import { paint } from "./steel.js";
import { clamp } from "./table.js";
import { strung } from "./toothed.js";

const DISCONNECT = "effects.disconnect";
const CLUTCHES = "effects.clutches";
const SIDES = ["left", "right"];

// Colours of the metals. Both halves of a clutch differ, because they turn at different speeds.
const OWN = { shafts: "#767d88", brakes: "#5b626c" };
const RINGS = ["#5b626c", "#b9bec6"]; // on the side gear, on the half-shaft
const PLATES = ["#8d949e", "#4b5058"]; // of the side gear, of the shaft of the clutch

// sizes per reach of the gears
const GAP = 0.06; // between parts of different speeds
const TAIL = 0.36; // half-shaft between a clutch and the flange
const PACK = { plates: 7, thick: 0.034, pitch: 0.046, own: 0.52, inner: 0.34, outer: 0.62, bars: 4, bar: 0.05 };
const DOG = { outer: 0.54, body: 0.08, tooth: 0.12, clear: 0.01, apart: 0.1 };
const LEAST_LASH = 0.06; // minimum drawn lash per pitch, so that flanks do not flicker
const FACETS = 72; // minimum number of facets of a ring

const CLOSED = 3; // first phase in which a dog clutch is closed
const PHASES = ["open", "waits for speed", "waits for a gap", "closed", "waits for low torque"];

export const hasPacks = (setup) => setup.value(CLUTCHES);

// True if a side has a dog clutch. `value(name)` is in SI.
const hasDog = (table, value, side) => value(DISCONNECT)
  && [side, "both"].includes(table.shown("disconnect.sides", value("disconnect.sides")));

// Values that determine the picture, for the left and the right side: `dog`, teeth and lash of the dog clutch, and `ratio`,
// the speed of the clutch's shaft over the carrier's. Each is null without its effect.
export function drawnClutches(table, value) {
  return SIDES.map((side) => ({
    dog: hasDog(table, value, side) ? { teeth: value("disconnect.teeth"), lash: value("disconnect.lash") } : null,
    ratio: value(CLUTCHES) ? value(`clutches.${side}_ratio`) : null,
  }));
}

// Parts with a line among the numbers next to the picture, by their name in `data-of`: true if the set-up has them.
export function clutchParts(setup) {
  const dogs = SIDES.map((side) => [`${side}-dog`, hasDog(setup.table, (name) => setup.value(name), side)]);
  return { ...Object.fromEntries(dogs), packs: hasPacks(setup) };
}

// Outputs for the picture of a set-up.
export function clutchOutputs(setup) {
  const parts = [...(setup.value(DISCONNECT) ? ["dog_phase", "wheel_angle"] : []), ...(hasPacks(setup) ? ["clutch_torque"] : [])];
  return SIDES.flatMap((side) => parts.map((part) => `${side}.${part}`));
}

// Texts of the states at the time of a record, by the ids of their elements; a dash for a state that is not recorded.
export function clutchTexts(record, table) {
  const text = (name, words) => (record.has(name) ? words(record.point(name)) : "–");
  return Object.fromEntries(SIDES.flatMap((side) => [
    [`${side}-dog`, text(`${side}.dog_phase`, (phase) => PHASES[phase])],
    [`${side}-clutch`, text(`${side}.clutch_torque`, (torque) => table.shown(`${side}.clutch_torque`, torque, 3))],
  ]));
}

// Light of the plates by the torque of each clutch, relative to the torque at full command: {side: {share, colour}}.
export function litPlates({ setup, record }, colour) {
  const full = setup.value("clutches.torque");
  const share = (side) => clamp(Math.abs(record.value(`${side}.clutch_torque`)) / full || 0, 0, 1);
  return Object.fromEntries(SIDES.map((side) => [side, { share: share(side), colour }]));
}

export class HalfShaft {
  // `side` is 1 on the left and −1 on the right. Distances from the apex are `begin` of the half-shaft in the side gear,
  // `start` of its part outside the case, and `end` at the wheel. `dog` and `ratio` are those of `drawnClutches`.
  constructor({ side, reach, begin, start, end, dog, ratio, metal }) {
    const metals = (colours) => colours.map((colour) => metal(colour));
    Object.assign(this, { side, reach, end, dog, ratio, name: SIDES[side > 0 ? 0 : 1], group: new Group(), named: {} });
    this.metals = Object.fromEntries(Object.entries(OWN).map(([name, colour]) => [name, metal(colour)]));
    [this.rings, this.plates] = [dog ? metals(RINGS) : [], ratio === null ? [] : metals(PLATES)];
    // parts that turn with the side gear, with the wheel, and with the shaft of the clutch
    this.parts = { gear: new Group(), wheel: new Group(), drum: new Group() };
    this.group.add(...Object.values(this.parts));
    // begin of the half-shaft, and of its part that no clutch covers
    let [from, free] = [begin, begin];
    if (ratio !== null) free = this.pack(start + GAP * reach, metal);
    if (dog) {
      free = this.dogClutch(begin, Math.max(start, free) + GAP * reach, metal);
      from = free;
    }
    this.wheel(from, free, metal);
  }

  // Length of clutches outside the case, with the half-shaft behind them; 0 without clutches.
  static length(reach, { dog, ratio }) {
    const [pack, clutch] = [ratio === null ? 0 : packLength() + GAP, dog ? dogLength() : 0];
    return pack + clutch > 0 ? reach * (GAP + pack + clutch + TAIL) : 0;
  }

  // Half-shaft from a position to the flange of the wheel. A stripe on its free part makes the rotation visible.
  wheel(from, free, metal) {
    const { side, reach, end, metals } = this;
    const radius = shaftRadius(reach);
    const bar = disc(radius, end - from, (side * (from + end)) / 2, metals.shafts);
    const plate = disc(1.55 * radius, 6, side * end, metals.brakes);
    const long = Math.min(0.5 * reach, end - free - 6);
    const stripe = around(mark(long, 0.8, 2.4, metal), side * (end - long / 2 - 3), radius, 0);
    this.parts.wheel.add(bar, plate, ...bolts(5, 2, 14, 12, side * end, 1.25 * radius, metal), stripe);
  }

  // Pack of plates from a position on; returns its end. Bars connect the plates of the clutch's shaft. One of them, and a
  // mark on the last plate of the side gear, make the slip visible.
  pack(from, metal) {
    const { side, reach, plates: [own, other], parts: { gear, drum } } = this;
    const sized = (size) => size * reach;
    const length = sized(packLength());
    for (let k = 0; k < PACK.plates; k += 1) {
      const isOwn = k % 2 === 0;
      const radii = isOwn ? [shaftRadius(reach), sized(PACK.own)] : [sized(PACK.inner), sized(PACK.outer)];
      (isOwn ? gear : drum).add(along(side, ring(...radii, from + sized(PACK.pitch) * k, sized(PACK.thick), isOwn ? own : other)));
    }
    for (let k = 0; k < PACK.bars; k += 1) {
      const bar = new Mesh(new BoxGeometry(length, sized(PACK.bar), 2 * sized(PACK.bar)), k === 0 ? metal(MARK, 0.6) : other);
      drum.add(around(bar, side * (from + length / 2), sized(PACK.outer), (2 * Math.PI * k) / PACK.bars));
    }
    const [inner, outer] = [shaftRadius(reach), sized(PACK.own)];
    gear.add(around(mark(0.8, 0.9 * (outer - inner), 2.4, metal), side * (from + length), (inner + outer) / 2, 0));
    this.named.clutch = [side * (from + length / 2), -1.35 * sized(PACK.outer), 0];
    return from + length;
  }

  // Dog clutch from a position on, with a stub of the side gear. Returns the position at which the half-shaft begins.
  dogClutch(begin, from, metal) {
    const { side, reach, dog, rings: [own, other], parts: { gear }, metals } = this;
    const [body, tooth, clear] = ["body", "tooth", "clear"].map((part) => DOG[part] * reach);
    const [radius, outer] = [shaftRadius(reach), DOG.outer * reach];
    const root = from + body;
    gear.add(disc(radius, root - begin, (side * (begin + root)) / 2, metals.shafts));
    gear.add(new Mesh(crown(dog, [radius, outer], side * from, side * root, side * (root + tooth), 0), own));
    // the other half in engagement
    const back = root + tooth + clear;
    const half = Math.PI / dog.teeth;
    this.slide = tooth + DOG.apart * reach;
    this.sleeve = new Group();
    this.sleeve.add(new Mesh(crown(dog, [radius, outer], side * (back + body), side * back, side * (root + clear), half), other));
    // its hub, which slides into the half-shaft when the clutch opens
    const hub = body + this.slide;
    this.sleeve.add(disc(0.85 * radius, hub, side * (back + hub / 2), metals.shafts));
    for (const [part, at] of [[gear, from], [this.sleeve, back]]) {
      part.add(around(mark(body, 0.8, 0.1 * reach, metal), side * (at + body / 2), outer, 0));
    }
    this.group.add(this.sleeve);
    this.named.dog = [side * (root + tooth), 1.45 * outer, 0];
    return back + this.slide;
  }

  // Positions of names next to the clutches.
  get labels() {
    return Object.fromEntries(Object.entries(this.named).map(([part, place]) => [`${this.name}-${part}`, new Vector3(...place)]));
  }

  // Draws the positions at the time of the last call of `record.seek`, with the angle of the carrier.
  turn(record, carrier) {
    const read = (output) => record.value(`${this.name}.${output}`);
    const [angle, twist] = [read("angle"), read("twist")];
    const { gear, wheel, drum } = this.parts;
    gear.rotation.x = angle;
    drum.rotation.x = (this.ratio ?? 0) * carrier;
    // a run that began before the clutch was drawn does not contain its state
    const hasState = this.dog && record.has(`${this.name}.dog_phase`);
    // a dog clutch may engage some teeth away from where it opened
    wheel.rotation.x = hasState ? read("wheel_angle") : angle - twist;
    if (!this.dog) return;
    const isOpen = hasState && record.point(`${this.name}.dog_phase`) < CLOSED;
    this.sleeve.position.x = isOpen ? this.side * this.slide : 0;
    // the half-shaft twists behind the teeth, which move only within their lash
    const most = this.dog.lash / 2;
    this.sleeve.rotation.x = wheel.rotation.x + twist - clamp(twist, -most, most);
  }

  // Colours the parts by their names in colouring.js, and lights the plates.
  paint({ parts, plates }) {
    for (const [name, own] of Object.entries(OWN)) paint(this.metals[name], own, parts[name]);
    this.rings.forEach((metal, k) => paint(metal, RINGS[k], parts.dogs));
    const { share, colour } = plates?.[this.name] ?? { share: 0 };
    this.plates.forEach((metal, k) => paint(metal, PLATES[k], share > 0.01 ? new Color(PLATES[k]).lerp(colour, share) : undefined));
  }
}

const packLength = () => PACK.pitch * (PACK.plates - 1) + PACK.thick;
const dogLength = () => 2 * DOG.body + 2 * DOG.tooth + DOG.clear + DOG.apart;

// Turns a ring about y to the axis x, toward a side.
function along(side, part) {
  part.rotation.z = (-side * Math.PI) / 2;
  return part;
}

// Puts a part at a position along the axis, at a distance from it and at an angle about it.
function around(part, place, radius, angle) {
  part.position.set(place, radius * Math.cos(angle), radius * Math.sin(angle));
  part.rotation.x = angle;
  return part;
}

// Mark that makes a rotation visible, with its sizes along the axis, across it, and around it.
const mark = (long, high, wide, metal) => new Mesh(new BoxGeometry(long, high, wide), metal(MARK, 0.6));

// Ring with face teeth. Positions along the axis are `back`, `root` of the teeth, and `tip`; a tooth is centred on the angle
// `first`. Teeth are narrower than gaps by the lash.
function crown({ teeth, lash }, [inner, outer], back, root, tip, first) {
  const pitch = (2 * Math.PI) / teeth;
  const wide = clamp((pitch - Math.max(lash, LEAST_LASH * pitch)) / 2, 0.1 * pitch, 0.5 * pitch);
  const facets = Math.ceil(FACETS / (2 * teeth));
  const land = (from, to, place) => Array.from({ length: facets + 1 }, (_, k) => [from + ((to - from) * k) / facets, place]);
  const outline = Array.from({ length: teeth }, (_, k) => first + k * pitch).flatMap((middle) => [
    ...land(middle - wide / 2, middle + wide / 2, tip), ...land(middle + wide / 2, middle + pitch - wide / 2, root),
  ]);
  const loop = (radius, place) => outline.map(([angle, own]) => [place ?? own, radius * Math.cos(angle), radius * Math.sin(angle)]);
  return creased(strung([loop(inner, back), loop(inner), loop(outer), loop(outer, back), loop(inner, back)]));
}
