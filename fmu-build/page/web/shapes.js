// The gears of the picture: new surfaces where the geometry has changed, those of the start values where none can be built.
import { Assembly } from "./assembly.js";

const isGeometry = (table) => ({ reference }) => table.variables[reference].name.startsWith("geometry.");

export class Shapes {
  // `ask(settings)` asks the worker for surfaces; `built(surfaces, assembly)` takes them.
  constructor(table, ask, built) {
    Object.assign(this, { table, ask, built, key: null, waiting: [] });
  }

  // The gears of a set-up, unless they are those that were asked for last.
  want(setup) {
    const settings = setup.settings();
    const key = JSON.stringify(settings.filter(isGeometry(this.table)));
    if (key === this.key) return;
    this.key = key;
    this.request(settings, (name) => setup.value(`geometry.${name}`));
  }

  // The worker answers in the order of the requests.
  take({ surfaces }) {
    const value = this.waiting.shift();
    if (!surfaces.includes(null)) this.show(surfaces, value);
    else this.standIn();
  }

  // Gears of the start values where there are none yet: asked for once.
  standIn() {
    if (this.shown || this.isStandIn) return;
    this.isStandIn = true;
    this.request([], (name) => this.table.find(`geometry.${name}`).start);
  }

  // A worker that is gone answers no more: the next set-up asks again.
  forget() {
    this.key = null;
    this.waiting = [];
  }

  request(settings, value) {
    // values of now: the set-up may change before the answer comes
    const names = ["planet_teeth", "side_teeth", "planet_count", "pressure_angle"];
    const values = new Map(names.map((name) => [name, value(name)]));
    this.waiting.push((name) => values.get(name));
    this.ask(settings);
  }

  show(surfaces, value) {
    this.shown = true;
    const [planet, side] = surfaces.map(({ cones }) => cones);
    this.built(surfaces, new Assembly({
      planetTeeth: value("planet_teeth"), sideTeeth: value("side_teeth"), planets: value("planet_count"),
      pressureAngle: value("pressure_angle"), planet, side,
    }));
  }
}
