// Numbers next to the picture: speeds, heat, time, and the rate of slow motion.
import { readable, shown } from "./table.js";

const $ = (id) => document.getElementById(id);

// Time in which the planets pass one tooth [s]. If they hardly spin, time in which the side gears pass one tooth with
// the carrier.
export function toothTime(record, parameter) {
  const passed = (name) => {
    const column = record.column(name);
    return column.length > 1 ? Math.abs(column[column.length - 1] - column[0]) / record.end : 0;
  };
  const spin = passed("planet[1].spin_angle") * parameter("geometry.planet_teeth");
  const turn = passed("carrier.angle") * parameter("geometry.side_teeth");
  return (2 * Math.PI) / (spin > 0.1 * turn ? spin : turn);
}

// Values at the time of the last call of `record.seek`.
export function showFigures(record, table) {
  for (const part of ["carrier", "left", "right"]) {
    $(`${part}-speed`).textContent = shown(table.find(`${part}.speed`), record.value(`${part}.speed`), 4);
  }
  const heat = record.names.filter((name) => name.startsWith("heat.")).reduce((sum, name) => sum + record.value(name), 0);
  const rest = record.value("solver.energy_residual");
  $("energy").textContent = `heat ${readable(heat, 3)} J, energy balance open by ${readable(rest, 2)} J`;
}

export function showTransport({ time, stop, rate, playing, share }, tooth) {
  const digits = Math.max(0, Math.min(6, 3 - Math.floor(Math.log10(stop))));
  $("clock").textContent = `${time.toFixed(digits)} of ${readable(stop, 4)} s`;
  $("play").textContent = playing ? "❚❚" : "▶";
  if (document.activeElement !== $("time") || playing) $("time").value = time;
  if (document.activeElement !== $("rate")) $("rate").value = share;
  const pace = rate > 0.95 ? "real time" : `1/${readable(1 / rate, 2)}`;
  $("rate-text").textContent = Number.isFinite(tooth) ? `${pace}, ${readable(tooth / rate, 2)} s a tooth` : pace;
}
