// Plot of several outputs with the same unit, and its legend.
import uPlot from "uplot";
import { readable, unitText, words } from "./table.js";

export const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// `series`: [{name, stroke}]; `range` returns the ends of the first axis, `after` is the unit behind its last number,
// and `draw` is called after drawing. Returns {plot, room, series, values}: the plot, its element, the series, and the
// elements for values in the legend.
export function panel(host, { unit, series, range, after, draw }) {
  const frame = Object.assign(document.createElement("div"), { className: "panel" });
  const legend = Object.assign(document.createElement("div"), { className: "legend" });
  const values = series.map(({ name, stroke }) => {
    const item = document.createElement("span");
    item.style.setProperty("--own", stroke);
    item.title = name;
    item.append(words(name), " ", document.createElement("b"));
    legend.append(item);
    return item.lastChild;
  });
  const room = Object.assign(document.createElement("div"), { className: "plot" });
  frame.append(legend, room);
  host.append(frame);
  const axis = {
    stroke: colour("--soft"), grid: { stroke: colour("--line"), width: 1 }, ticks: { show: false }, font: "11px system-ui",
  };
  const plot = new uPlot({
    width: 300, height: 100, legend: { show: false }, padding: [6, 10 + 6 * after.length, 0, 0],
    cursor: { y: false, drag: { setScale: false, x: false, y: false }, points: { show: false } },
    scales: { x: { time: false, range }, y: { range: span } },
    axes: [
      { ...axis, size: 20, gap: 3,
        values: (_, ticks) => ticks.map((tick, i) => readable(tick) + (i === ticks.length - 1 ? after : "")) },
      { ...axis, size: 62, gap: 4, label: unitText(unit) || "1", labelSize: 16, labelFont: "11px system-ui",
        values: (_, ticks) => ticks.map((tick) => readable(tick)) },
    ],
    series: [{}, ...series.map(({ name, stroke }) => ({ label: name, stroke, width: 1.7, points: { show: false } }))],
    hooks: { draw: [draw] },
  }, [[], ...series.map(() => [])], room);
  return { plot, room, series, values };
}

// Range of an axis. It has a minimum width, so that a constant value is not magnified to noise.
function span(_, least, most) {
  if (least === null || !Number.isFinite(least)) return [0, 1];
  const room = Math.max(most - least, 1e-3 * Math.max(Math.abs(most), Math.abs(least)), 1e-12);
  return [least - 0.12 * room, most + 0.12 * room];
}
