// Interface to the worker: one run at a time, the latest request takes precedence, and a failed or hanging worker is
// replaced.
import program from "worker:worker.js";

const PATIENCE = 1000; // ms for which an obsolete run may occupy the worker

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
    const isOld = message.number !== undefined && message.number !== this.number;
    if (isOld) return;
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
