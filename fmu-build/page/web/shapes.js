// Gears of the picture: new surfaces after a change of geometry, or those of the start values if none can be built.
import { Assembly } from "./assembly.js";

const isGeometry = (table) => ({ reference }) => table.variables[reference].name.startsWith("geometry.");

export class Shapes {
  // `ask(settings)` requests surfaces from the worker; `built(surfaces, assembly)` receives them.
  constructor(table, ask, built) {
    Object.assign(this, { table, ask, built, key: null, waiting: [] });
  }

  // Requests the gears of a set-up, unless they were requested last.
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

  // Requests gears of the start values once, if there are none yet.
  standIn() {
    if (this.shown || this.isStandIn) return;
    this.isStandIn = true;
    this.request([], (name) => this.table.find(`geometry.${name}`).start);
  }

  // After the loss of a worker, outstanding answers never come, so the next set-up requests the gears again.
  forget() {
    this.key = null;
    this.waiting = [];
  }

  request(settings, value) {
    // values at the time of the request: the set-up may change before the answer arrives
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
