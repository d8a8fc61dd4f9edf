// Time of the picture, and the numbers next to the picture: speeds, clutches, heat, time, and the rate of slow motion.
import { $ } from "./frame.js";
import { clutchTexts } from "./half_shafts.js";
import { heats } from "./record.js";
import { clamp, readable } from "./table.js";

const SHOW = 15; // s on the screen for a run, by default
const TOOTH = 10; // s on the screen for one tooth in the slowest motion

// The time plays, pauses, seeks, and restarts at the end.
export class Player {
  constructor() {
    Object.assign(this, { time: 0, stop: 1, playing: true, rate: 1, slowest: 0.01, chosen: false });
  }

  // Starts a new run of the duration `stop`.
  begin(stop) {
    this.stop = stop;
    this.time = Math.min(this.time, stop);
    this.slowest = Math.min(stop / SHOW, 1) / 20;
    if (!this.chosen) this.rate = Math.min(stop / SHOW, 1);
    this.rate = clamp(this.rate, this.slowest, 1);
  }

  // Limits slow motion: at the slowest, one tooth takes ten seconds. `tooth` is its time in the run, Infinity if
  // nothing turns.
  limit(tooth) {
    if (!(tooth > 0 && Number.isFinite(tooth))) return;
    this.slowest = Math.min(tooth / TOOTH, this.stop / SHOW, 1);
    this.rate = Math.max(this.rate, this.slowest);
  }

  // Advances by `seconds` of the clock; `end` is the end of the run so far, and `isOver` is true if the run is
  // complete.
  tick(seconds, end, isOver) {
    if (!this.playing) return;
    this.time += this.rate * seconds;
    if (this.time <= end) return;
    this.time = isOver ? 0 : end;
  }

  seek(time) {
    this.time = clamp(time, 0, this.stop);
  }

  // Slider of slow motion: 0 the slowest, 1 real time.
  get share() {
    return this.slowest >= 1 ? 1 : 1 - Math.log(this.rate) / Math.log(this.slowest);
  }

  set share(share) {
    this.chosen = true;
    this.rate = this.slowest ** (1 - share);
  }
}

// Time in which the planets pass one tooth [s]. If they hardly spin, time in which the side gears pass one tooth with
// the carrier.
export function toothTime(record, parameter) {
  const passed = (name) => {
    const column = record.column(name);
    return column.length > 1 ? Math.abs(column.at(-1) - column[0]) / record.end : 0;
  };
  const spin = passed("planet[1].spin_angle") * parameter("geometry.planet_teeth");
  const turn = passed("carrier.angle") * parameter("geometry.side_teeth");
  return (2 * Math.PI) / (spin > 0.1 * turn ? spin : turn);
}

// Values at the time of the last call of `record.seek`.
export function showFigures(record, table) {
  for (const part of ["carrier", "left", "right", "pinion"]) {
    $(`${part}-speed`).textContent = table.shown(`${part}.speed`, record.value(`${part}.speed`), 4);
  }
  for (const [id, text] of Object.entries(clutchTexts(record, table))) $(id).textContent = text;
  const heat = heats(table).reduce((sum, name) => sum + record.value(name), 0);
  const rest = record.value("solver.energy_residual");
  $("energy").textContent = `heat ${readable(heat, 3)} J, energy balance open by ${readable(rest, 2)} J`;
}

export function showTransport({ time, stop, rate, playing, share }, tooth) {
  const digits = clamp(3 - Math.floor(Math.log10(stop)), 0, 6);
  $("clock").textContent = `${time.toFixed(digits)} of ${readable(stop, 4)} s`;
  $("play").textContent = playing ? "❚❚" : "▶";
  if (document.activeElement !== $("time") || playing) $("time").value = time;
  if (document.activeElement !== $("rate")) $("rate").value = share;
  const pace = rate > 0.95 ? "real time" : `1/${readable(1 / rate, 2)}`;
  $("rate-text").textContent = Number.isFinite(tooth) ? `${pace}, ${readable(tooth / rate, 2)} s a tooth` : pace;
}
