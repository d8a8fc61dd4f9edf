// The worker as the page sees it: one run at a time, the latest request wins, and a trap starts a new worker.
import program from "worker:worker.js";

const PATIENCE = 1000; // ms without a word after which a new run takes a new worker

export class Simulation {
  // `on`: functions ready, gears, started, points, over, refused, trap; each takes the worker's message.
  constructor(bytes, on) {
    this.bytes = bytes;
    this.on = on;
    this.number = 0;
    this.address = URL.createObjectURL(new Blob([program], { type: "text/javascript" }));
    this.begin();
  }

  begin() {
    this.worker?.terminate();
    this.isReady = false;
    this.isBusy = false;
    this.worker = new Worker(this.address);
    this.worker.onmessage = ({ data }) => this.hear(data);
    this.worker.onerror = (event) => this.fall(event.message || "the worker failed");
    this.worker.postMessage({ kind: "load", bytes: this.bytes });
  }

  hear(message) {
    this.heard = performance.now();
    if (message.kind === "ready") this.isReady = true;
    if (message.number === this.number && message.kind !== "started" && message.kind !== "points") this.isBusy = false;
    const isOld = message.number !== undefined && message.number !== this.number;
    if (message.kind === "trap") this.fall(message.text);
    else if (!isOld) this.on[message.kind](message);
  }

  // A worker that has never been ready is not tried again.
  fall(text) {
    if (this.isReady) this.begin();
    this.on.trap({ text });
  }

  run(scene, references, constants) {
    // a step that takes long hears nothing
    if (this.isBusy && this.isReady && performance.now() - this.heard > PATIENCE) this.begin();
    this.isBusy = true;
    this.number += 1;
    this.worker.postMessage({ kind: "run", number: this.number, scene, references, constants });
  }

  gears(settings) {
    this.worker.postMessage({ kind: "gears", settings });
  }
}
