// The worker: it owns the library, runs scenes and makes surfaces of gears. It answers every request with messages.
import { XzReadableStream } from "xz-decompress";
import { Library, Refused } from "./library.js";
import { Run } from "./run.js";

const BATCH = 30; // ms of simulation between two messages
const MOST = 500; // points in a message

const WARM = 700; // ms at most before the first run
const FASTER = 6; // times: how much faster a run is when it is compiled well

let library = null;
let loaded = null; // settles when the library is there
let isWarm = false;
let current = 0; // number of the run that is wanted

// Lets messages in.
const pause = () => new Promise((resolve) => {
  const { port1, port2 } = new MessageChannel();
  port1.onmessage = () => resolve(port1.close());
  port2.postMessage(null);
});

// Compiles while it unpacks.
function compiled(packed) {
  const stream = new XzReadableStream(new Blob([packed]).stream());
  return WebAssembly.compileStreaming(new Response(stream, { headers: { "Content-Type": "application/wasm" } }));
}

const requests = {
  async load({ packed, module }) {
    const made = module ?? await compiled(packed);
    library = await Library.of(made);
    // what another worker has run is compiled already
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

// A browser compiles what runs often once more, to faster code. The first scene runs over and over for that, reading what will be
// noted: other scenes and outputs take other ways through the library.
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

// Warnings of the library since they were last asked for.
const warned = () => library.said().filter(({ status }) => status > 0).map(({ text }) => text);

// The run that is shown.
async function noted(number, scene, reader) {
  const run = new Run(library, scene);
  postMessage({ kind: "started", number, warnings: warned() });
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

// Points of a run for one message: rows of time and what the reader reads.
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

  // Goes on with the run for a while; returns the time it took [ms].
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
    // a trap leaves the library in no state to go on
    const kind = error instanceof Refused ? "refused" : "trap";
    postMessage({ kind, number: data.number, text: String(error.message ?? error) });
  }
};
