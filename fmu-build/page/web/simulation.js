// Requests to the worker: runs of set-ups, and surfaces of gears.
import program from "worker:worker.js";
import { drawnDrive } from "./final_drive.js";
import { drawnClutches } from "./half_shafts.js";

const PATIENCE = 1000; // ms for which an obsolete run may occupy the worker
// geometry that determines the positions of gears
const GEOMETRY = {
  planetTeeth: "planet_teeth", sideTeeth: "side_teeth", planets: "planet_count", pressureAngle: "pressure_angle",
};

// Interface to the worker: one run at a time, the latest request takes precedence, and a failed or hanging worker is
// replaced.
export class Simulation {
  // `packed`: the packed library of the page. `on`: functions gears, started, points, over, refused and trap, each for
  // a message of the worker, and `anew`, called when a worker replaces another one.
  constructor(packed, on) {
    Object.assign(this, { packed, on, number: 0, module: null });
    this.address = URL.createObjectURL(new Blob([program], { type: "text/javascript" }));
    this.begin();
  }

  begin() {
    this.worker?.terminate();
    clearTimeout(this.watch);
    this.isBusy = false;
    this.isReady = false;
    this.worker = new Worker(this.address);
    this.worker.onmessage = ({ data }) => this.hear(data);
    this.worker.onerror = (event) => this.fall(event.message || "the worker failed");
    // the next worker reuses the compiled module
    this.worker.postMessage({ kind: "load", packed: this.packed, module: this.module });
  }

  hear(message) {
    if (message.kind === "ready") {
      this.isReady = true;
      this.module = message.module;
      return;
    }
    if (message.kind === "trap") {
      this.fall(message.text);
      return;
    }
    // answers to an old run are discarded
    if (message.number !== undefined && message.number !== this.number) return;
    if (message.number === this.number) {
      clearTimeout(this.watch);
      this.isBusy = ["taken", "started", "points"].includes(message.kind);
    }
    if (message.kind !== "taken") this.on[message.kind](message);
  }

  // A worker that was never ready is not replaced.
  fall(text) {
    if (this.isReady) {
      this.begin();
      this.on.anew();
    }
    this.on.trap({ text });
  }

  run(scene, references) {
    this.number += 1;
    const request = { kind: "run", number: this.number, scene, references };
    clearTimeout(this.watch);
    // a hanging step receives no new request
    if (this.isBusy && this.isReady) this.watch = setTimeout(() => this.replace(request), PATIENCE);
    this.isBusy = true;
    this.worker.postMessage(request);
  }

  replace(request) {
    this.begin();
    this.isBusy = true;
    this.worker.postMessage(request);
    this.on.anew();
  }

  gears(settings) {
    this.worker.postMessage({ kind: "gears", settings });
  }
}

// Gears of the picture: new surfaces after a change of geometry, or those of the start values if none can be built.
export class Shapes {
  // `ask(settings)` requests surfaces from the worker; `built(surfaces, geometry)` receives them with the geometry of
  // their request.
  constructor(table, ask, built) {
    Object.assign(this, { table, ask, built, key: null, waiting: [] });
  }

  // Requests the gears of a set-up, unless they were requested last.
  want(setup) {
    const settings = setup.settings();
    const isGeometry = ({ reference }) => this.table.variables[reference].name.startsWith("geometry.");
    const value = (name) => setup.value(name);
    const drive = drawnDrive(this.table, value);
    const key = JSON.stringify([settings.filter(isGeometry), drive, drawnClutches(this.table, value)]);
    if (key === this.key) return;
    this.key = key;
    this.request(settings, value, drive);
  }

  // The worker answers in the order of the requests.
  take({ surfaces }) {
    const geometry = this.waiting.shift();
    if (surfaces.includes(null)) {
      this.standIn();
      return;
    }
    this.shown = true;
    this.built(surfaces, geometry);
  }

  // Requests gears of the start values once, if there are none yet.
  standIn() {
    if (this.shown || this.isStandIn) return;
    this.isStandIn = true;
    this.request([], (name) => this.table.find(name).start, null);
  }

  // After the loss of a worker, outstanding answers never come, so the next set-up requests the gears again.
  forget() {
    this.key = null;
    this.waiting = [];
  }

  // `drive` is the final drive of the set-up, or null.
  request(settings, value, drive) {
    // values at the time of the request: the set-up may change before the answer arrives
    const geometry = Object.fromEntries(Object.entries(GEOMETRY).map(([key, name]) => [key, value(`geometry.${name}`)]));
    this.waiting.push({ ...geometry, drive, clutches: drawnClutches(this.table, value) });
    this.ask(settings);
  }
}
