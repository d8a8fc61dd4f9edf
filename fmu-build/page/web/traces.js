// Outputs over time, a plot for each unit, scrolling with the picture; a press in a plot seeks.
import uPlot from "uplot";
import { readable, shown, unitText } from "./table.js";

const COLOURS = ["--trace-1", "--trace-2", "--trace-3", "--trace-4", "--trace-5", "--trace-6"];
export const MOST = COLOURS.length;
const AHEAD = 0.2; // part of the window after now

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export class Traces {
  // `seek(time)` is called with the time pressed on.
  constructor(host, table, seek) {
    Object.assign(this, { host, table, seek, plots: [], now: 0, share: 1 });
    this.sizes = new ResizeObserver(() => this.fit());
    this.sizes.observe(host);
  }

  // Starts anew for these outputs of a record that will last to `stop`.
  begin(names, record, stop) {
    Object.assign(this, { names, record, stop });
    for (const { plot } of this.plots) plot.destroy();
    this.host.replaceChildren();
    const units = new Map();
    names.forEach((name, i) => {
      const unit = this.table.find(name).shown;
      if (!units.has(unit)) units.set(unit, []);
      units.get(unit).push({ name, stroke: colour(COLOURS[i % MOST]) });
    });
    this.plots = [...units].map(([unit, series]) => this.panel(unit, series));
    this.fit();
    this.refresh();
  }

  panel(unit, series) {
    const frame = document.createElement("div");
    frame.className = "panel";
    const legend = document.createElement("div");
    legend.className = "legend";
    const values = series.map(({ name, stroke }) => {
      const item = document.createElement("span");
      item.style.setProperty("--own", stroke);
      item.append(name, " ", document.createElement("b"));
      legend.append(item);
      return item.lastChild;
    });
    const room = document.createElement("div");
    room.className = "plot";
    frame.append(legend, room);
    this.host.append(frame);
    const ink = colour("--soft");
    const axis = { stroke: ink, grid: { stroke: colour("--line"), width: 1 }, ticks: { show: false }, font: "11px system-ui" };
    const plot = new uPlot({
      width: 300, height: 100, legend: { show: false }, padding: [6, 20, 0, 0],
      cursor: { y: false, drag: { setScale: false, x: false, y: false }, points: { show: false } },
      scales: { x: { time: false, range: () => this.window() }, y: { range: span } },
      axes: [
        { ...axis, size: 20, gap: 3, values: (_, ticks) => ticks.map((tick, i) => `${readable(tick)}${i === ticks.length - 1 ? " s" : ""}`) },
        { ...axis, size: 62, gap: 4, label: unitText(unit) || "1", labelSize: 16, labelFont: "11px system-ui",
          values: (_, ticks) => ticks.map((tick) => readable(tick)) },
      ],
      series: [{}, ...series.map(({ name, stroke }) => ({ label: name, stroke, width: 1.7, points: { show: false } }))],
      hooks: { draw: [(own) => this.drawNow(own)] },
    }, [[], ...series.map(() => [])], room);
    const press = (event) => {
      if (event.buttons === 1) this.seek(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x"));
    };
    plot.over.addEventListener("pointerdown", press);
    plot.over.addEventListener("pointermove", press);
    return { plot, room, series, values };
  }

  // What of the time is drawn: all, or a window that moves along.
  window() {
    const width = this.stop * this.share;
    const begin = Math.min(Math.max(this.now - (1 - AHEAD) * width, 0), this.stop - width);
    return [begin, begin + width];
  }

  drawNow(plot) {
    const x = plot.valToPos(this.now, "x", true);
    const { top, height } = plot.bbox;
    plot.ctx.save();
    plot.ctx.fillStyle = colour("--accent");
    plot.ctx.fillRect(Math.round(x) - 1, top, 2, height);
    plot.ctx.restore();
  }

  // New points have come.
  refresh() {
    for (const { plot, series } of this.plots) {
      const columns = series.map(({ name }) => {
        const { factor } = this.table.find(name);
        return this.record.column(name).map((value) => factor * value);
      });
      plot.setData([this.record.times, ...columns]);
    }
  }

  // The picture is at this time.
  at(time) {
    this.now = time;
    for (const { plot, series, values } of this.plots) {
      if (this.share < 1) plot.setData(plot.data);
      else plot.redraw(false, false);
      series.forEach(({ name }, i) => { values[i].textContent = shown(this.table.find(name), this.record.value(name), 4); });
    }
  }

  fit() {
    for (const { plot, room } of this.plots) {
      if (room.clientWidth > 0) plot.setSize({ width: room.clientWidth, height: Math.max(room.clientHeight, 60) });
    }
  }
}

// Range of an axis: a value that does not change is not blown up to noise.
function span(_, least, most) {
  if (least === null || !Number.isFinite(least)) return [0, 1];
  const room = Math.max(most - least, 1e-3 * Math.max(Math.abs(most), Math.abs(least)), 1e-12);
  return [least - 0.12 * room, most + 0.12 * room];
}
