// The worker: it owns the library, runs scenes and computes surfaces of gears. It answers every request with messages.
import { XzReadableStream } from "xz-decompress";
import { Library, Refused, Run } from "./library.js";

const BATCH = 30; // ms of simulation between two messages
const MOST = 500; // maximum number of points in a message
const WARM = 700; // maximum warm-up before the first run in ms
const FASTER = 6; // speed-up of a run by optimised compilation

let library = null;
let loaded = null; // resolves when the library is loaded
let isWarm = false;
let current = 0; // number of the current run

// Lets the worker receive messages.
const pause = () => new Promise((resolve) => {
  const { port1, port2 } = new MessageChannel();
  port1.onmessage = () => resolve(port1.close());
  port2.postMessage(null);
});

// Compiles the library while unpacking it.
function compiled(packed) {
  const stream = new XzReadableStream(new Blob([packed]).stream());
  return WebAssembly.compileStreaming(new Response(stream, { headers: { "Content-Type": "application/wasm" } }));
}

const requests = {
  async load({ packed, module }) {
    const made = module ?? await compiled(packed);
    library = await Library.of(made);
    // a module from another worker is already compiled and optimised
    isWarm = Boolean(module);
    postMessage({ kind: "ready", module: made });
  },

  gears({ settings }) {
    const surfaces = [0, 1].map((gear) => library.gear(settings, gear));
    postMessage({ kind: "gears", surfaces });
  },

  async run({ number, scene, references }) {
    current = number;
    postMessage({ kind: "taken", number });
    const reader = library.reader(references);
    try {
      if (!isWarm) await warm(number, scene, reader);
      if (current === number) await noted(number, scene, reader);
    } finally {
      reader.free();
    }
    if (current === number) postMessage({ kind: "over", number, warnings: warned() });
  },
};

// Repeats the first scene to warm up: browsers compile frequently executed code again to faster code. The recorded
// outputs are read as well, because other scenes and outputs use other parts of the library.
async function warm(number, scene, reader) {
  const begin = performance.now();
  const isWanted = () => current === number && performance.now() - begin < WARM;
  let first = null;
  while (!isWarm && isWanted()) {
    const run = new Run(library, scene);
    const batch = new Batch(reader);
    let time = 0;
    while (!run.isOver && isWanted()) {
      time += batch.fill(run);
      await pause();
    }
    first ??= time;
    isWarm = run.isOver && time < first / FASTER;
  }
  isWarm = isWarm || current === number;
}

// Warnings of the library since the last call.
const warned = () => library.said().filter(({ status }) => status > 0).map(({ text }) => text);

// Runs the displayed scene.
async function noted(number, scene, reader) {
  const run = new Run(library, scene);
  postMessage({ kind: "started", number, warnings: [...run.warnings, ...warned()] });
  const batch = new Batch(reader);
  batch.note(run);
  let busy = 0;
  while (current === number) {
    busy += batch.fill(run);
    const points = batch.taken();
    postMessage({ kind: "points", number, points, time: run.time, seconds: busy / 1e3 }, [points.buffer]);
    if (run.isOver) break;
    await pause();
  }
}

// Points of a run for one message: rows of time and the reader's values.
class Batch {
  constructor(reader) {
    this.reader = reader;
    this.width = reader.count + 1;
    this.points = new Float64Array(this.width * MOST);
    this.count = 0;
  }

  note(run) {
    const place = this.width * this.count;
    this.points[place] = run.time;
    this.reader.read(this.points, place + 1);
    this.count += 1;
  }

  // Continues the run for a while; returns the elapsed time [ms].
  fill(run) {
    const begin = performance.now();
    this.count %= MOST;
    while (!run.isOver && this.count < MOST && performance.now() - begin < BATCH) {
      run.advance();
      this.note(run);
    }
    return performance.now() - begin;
  }

  taken() {
    const points = this.points.slice(0, this.width * this.count);
    this.count = 0;
    return points;
  }
}

onmessage = async ({ data }) => {
  try {
    if (data.kind === "load") loaded = requests.load(data);
    await loaded;
    if (data.kind !== "load") await requests[data.kind](data);
  } catch (error) {
    // after a trap, the library cannot continue
    const kind = error instanceof Refused ? "refused" : "trap";
    postMessage({ kind, number: data.number, text: String(error.message ?? error) });
  }
};
