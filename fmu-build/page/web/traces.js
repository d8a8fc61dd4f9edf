// Outputs over time, with a plot for each unit that scrolls with the picture, or their spectra. A press in a plot
// seeks.
import { colour, panel } from "./panel.js";
import { HIGHEST, spectrum } from "./spectrum.js";
import { inUnit, shown } from "./table.js";

const COLOURS = ["--trace-1", "--trace-2", "--trace-3", "--trace-4", "--trace-5", "--trace-6"];
const AHEAD = 0.2; // fraction of the window after the present time

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
    const units = new Map();
    this.names.forEach((name, i) => {
      const unit = this.table.find(name).shown;
      if (!units.has(unit)) units.set(unit, []);
      units.get(unit).push({ name, stroke: colour(COLOURS[i % COLOURS.length]) });
    });
    this.plots = [...units].map(([unit, series]) => this.panel(unit, series));
    this.fit();
    this.refresh();
    this.at(this.now);
  }

  panel(unit, series) {
    if (this.isSpectral) {
      return panel(this.host, { unit, series, range: () => [0, HIGHEST], after: " × mesh", draw: () => {} });
    }
    const made = panel(this.host, { unit, series, range: () => this.window(), after: " s", draw: (plot) => this.drawNow(plot) });
    const { over } = made.plot;
    const press = (event) => {
      if (event.buttons === 1) this.seek(made.plot.posToVal(event.clientX - over.getBoundingClientRect().left, "x"));
    };
    over.addEventListener("pointerdown", press);
    over.addEventListener("pointermove", press);
    return made;
  }

  // Drawn interval of time: the whole run, or a moving window.
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

  // Draws new points.
  refresh() {
    for (const { plot, series } of this.plots) {
      const columns = series.map(({ name }) => {
        const variable = this.table.find(name);
        return this.record.column(name).map((value) => inUnit(variable, value));
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
    for (const { plot, series, values } of this.plots) {
      if (!this.isSpectral && this.share < 1) plot.setData(plot.data);
      else if (!this.isSpectral) plot.redraw(false, false);
      series.forEach(({ name }, i) => { values[i].textContent = shown(this.table.find(name), this.record.value(name), 4); });
    }
  }

  fit() {
    for (const { plot, room } of this.plots) {
      if (room.clientWidth > 0) plot.setSize({ width: room.clientWidth, height: Math.max(room.clientHeight, 60) });
    }
  }
}
