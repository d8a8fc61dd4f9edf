// Outputs over time, or their spectra: the choice of outputs, and a plot for each unit.
import uPlot from "uplot";
import { colour, element } from "./frame.js";
import { between, isThere } from "./record.js";
import { MOST_TRACES } from "./setup.js";
import { clamp, FORCE, forceText, forceUnit, grouped, inUnit, readable, unitText, words } from "./table.js";

const COLOURS = ["--trace-1", "--trace-2", "--trace-3", "--trace-4", "--trace-5", "--trace-6"];
const AHEAD = 0.2; // fraction of the window after the present time
const HIGHEST = 8; // order of a spectrum
const FINEST = 4000; // maximum number of transformed points
const FONT = "11px system-ui";

// Choice of the outputs that are drawn.
export class TraceChoice {
  // `chosen(names)` is called when the reader changes the choice.
  constructor(host, table, chosen) {
    this.boxes = table.outputs().map(({ name, description }) => {
      const box = element("input", { type: "checkbox", value: name });
      host.append(element("label", { title: `${name}: ${description}` }, box, words(name)));
      box.addEventListener("change", () => chosen(this.names()));
      return box;
    });
  }

  names() {
    return this.boxes.filter((box) => box.checked).map((box) => box.value);
  }

  // Marks the drawn outputs. Only outputs of the first `planets` planets are offered.
  show(names, planets) {
    for (const box of this.boxes) {
      box.parentElement.hidden = !isThere(box.value, planets);
      box.checked = names.includes(box.value);
      box.disabled = !box.checked && names.length >= MOST_TRACES;
    }
    // the last one cannot be removed, because a page without traces has nothing to follow
    if (names.length === 1) this.boxes.find((box) => box.checked).disabled = true;
  }
}

// Plots that scroll with the picture. A press in a plot seeks.
export class Traces {
  // `seek(time)` is called with the pressed time.
  constructor(host, table, seek) {
    Object.assign(this, { host, table, seek, plots: [], names: [], now: 0, share: 1, isSpectral: false });
    new ResizeObserver(() => this.fit()).observe(host);
  }

  // Restarts with these outputs of a record that will reach `stop`.
  begin(names, record, stop) {
    Object.assign(this, { names, record, stop });
    this.build();
  }

  build() {
    for (const { plot } of this.plots) plot.destroy();
    this.host.replaceChildren();
    const series = this.names.map((name, i) => ({ name, stroke: colour(COLOURS[i % COLOURS.length]) }));
    const units = grouped(series, ({ name }) => this.table.find(name).shown);
    this.plots = [...units].map(([unit, own]) => this.panel(unit, own));
    this.fit();
    this.refresh();
    this.at(this.now);
  }

  panel(unit, series) {
    const axis = this.isSpectral
      ? { range: () => [0, HIGHEST], after: " × mesh", draw: () => {} }
      : { range: () => this.window(), after: " s", draw: (plot) => this.drawNow(plot) };
    const made = panel(this.host, { unit, series, ...axis });
    const { over } = made.plot;
    const press = (event) => {
      if (event.buttons !== 1 || this.isSpectral) return;
      this.seek(made.plot.posToVal(event.clientX - over.getBoundingClientRect().left, "x"));
    };
    over.addEventListener("pointerdown", press);
    over.addEventListener("pointermove", press);
    return made;
  }

  // Drawn interval of time: the whole run, or a moving window.
  window() {
    const width = this.stop * this.share;
    const begin = clamp(this.now - (1 - AHEAD) * width, 0, this.stop - width);
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

  // Draws new points.
  refresh() {
    for (const panel of this.plots) {
      const { plot, series } = panel;
      const isForce = panel.unit === FORCE;
      panel.largest = isForce ? Math.max(...series.map(({ name }) => this.record.largest(name))) : null;
      const { name: unit, factor } = forceUnit(panel.largest);
      if (isForce) plot.axes[1].label = unit;
      const columns = series.map(({ name }) => {
        const variable = this.table.find(name);
        return this.record.column(name).map((value) => factor * inUnit(variable, value));
      });
      plot.setData(this.isSpectral ? this.spectra(columns) : [this.record.times, ...columns]);
    }
  }

  // Spectra over common orders, or empty ones if the gears do not roll through a whole mesh cycle.
  spectra(columns) {
    const frequency = this.record.value("mesh.frequency");
    const made = columns.map((column) => spectrum(this.record.times, column, frequency));
    return made.includes(null) ? [[], ...columns.map(() => [])] : [made[0].orders, ...made.map(({ amplitudes }) => amplitudes)];
  }

  // Shows the values at the time of the picture.
  at(time) {
    this.now = time;
    for (const { plot, series, values, largest } of this.plots) {
      if (!this.isSpectral && this.share < 1) plot.setData(plot.data);
      else if (!this.isSpectral) plot.redraw(false, false);
      series.forEach(({ name }, i) => {
        const value = this.record.value(name);
        values[i].textContent = largest === null ? this.table.shown(name, value, 4) : forceText(value, 4, largest);
      });
    }
  }

  fit() {
    for (const { plot, room } of this.plots) {
      if (room.clientWidth > 0) plot.setSize({ width: room.clientWidth, height: Math.max(room.clientHeight, 60) });
    }
  }
}

// Plot of several outputs with the same unit, and its legend. `series`: [{name, stroke}]; `range` returns the ends of the
// first axis, `after` is the unit behind its last number, and `draw` is called after drawing. Returns {plot, room, unit, series,
// values}: the plot, its element, the unit, the series, and the elements for values in the legend.
function panel(host, { unit, series, range, after, draw }) {
  const values = series.map(() => element("b"));
  const items = series.map(({ name, stroke }, i) => {
    const item = element("span", { title: name }, words(name), " ", values[i]);
    item.style.setProperty("--own", stroke);
    return item;
  });
  const room = element("div", { className: "plot" });
  host.append(element("div", { className: "panel" }, element("div", { className: "legend" }, ...items), room));
  const axis = { stroke: colour("--soft"), grid: { stroke: colour("--line"), width: 1 }, ticks: { show: false }, font: FONT };
  const plot = new uPlot({
    width: 300, height: 100, legend: { show: false }, padding: [6, 10 + 6 * after.length, 0, 0],
    cursor: { y: false, drag: { setScale: false, x: false, y: false }, points: { show: false } },
    scales: { x: { time: false, range }, y: { range: span } },
    axes: [
      { ...axis, size: 20, gap: 3,
        values: (_, ticks) => ticks.map((tick, i) => readable(tick) + (i === ticks.length - 1 ? after : "")) },
      { ...axis, size: 62, gap: 4, label: unitText(unit) || "1", labelSize: 16, labelFont: FONT,
        values: (_, ticks) => ticks.map((tick) => readable(tick)) },
    ],
    series: [{}, ...series.map(({ name, stroke }) => ({ label: name, stroke, width: 1.7, points: { show: false } }))],
    hooks: { draw: [draw] },
  }, [[], ...series.map(() => [])], room);
  return { plot, room, unit, series, values };
}

// Range of an axis. It has a minimum width, so that a constant value is not magnified to noise.
function span(_, least, most) {
  if (least === null || !Number.isFinite(least)) return [0, 1];
  const room = Math.max(most - least, 1e-3 * Math.max(Math.abs(most), Math.abs(least)), 1e-12);
  return [least - 0.12 * room, most + 0.12 * room];
}

// Amplitudes of an output over orders of the mesh: order 1 is one period per tooth, order 2 two periods. Returns {orders,
// amplitudes} of the last whole mesh cycles, or null if the record contains none. `frequency` is the mesh frequency [Hz].
// The amplitude at order k is A in A cos(2 pi k f t), from Fourier sums over whole cycles.
function spectrum(times, values, frequency) {
  const cycles = Math.floor((times.at(-1) - times[0]) * Math.abs(frequency) + 1e-9);
  if (cycles < 1 || times.length < 8) return null;
  const count = Math.min(times.length, FINEST);
  const points = resampled(times, values, cycles / Math.abs(frequency), count);
  const mean = points.reduce((sum, value) => sum + value, 0) / count;
  const lines = Math.min(HIGHEST * cycles, Math.floor(count / 2) - 1);
  const orders = Float64Array.from({ length: lines }, (_, k) => (k + 1) / cycles);
  const amplitudes = orders.map((_, k) => {
    let [real, imaginary] = [0, 0];
    const turn = (2 * Math.PI * (k + 1)) / count;
    for (let i = 0; i < count; i += 1) {
      real += (points[i] - mean) * Math.cos(turn * i);
      imaginary += (points[i] - mean) * Math.sin(turn * i);
    }
    return (2 / count) * Math.hypot(real, imaginary);
  });
  return { orders, amplitudes };
}

// Resamples the last `length` seconds at equal intervals, by linear interpolation.
function resampled(times, values, length, count) {
  const begin = times.at(-1) - length;
  let after = 1;
  return Float64Array.from({ length: count }, (_, i) => {
    const time = begin + (length * i) / count;
    while (after < times.length - 1 && times[after] < time) after += 1;
    return values[after - 1] + between(time, times[after - 1], times[after]) * (values[after] - values[after - 1]);
  });
}
