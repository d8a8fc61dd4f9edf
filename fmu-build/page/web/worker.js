// The worker: it owns the library, runs scenes and makes surfaces of gears. It answers every request with messages.
import { XzReadableStream } from "xz-decompress";
import { Library, Refused } from "./library.js";
import { Run } from "./run.js";

const BATCH = 30; // ms of simulation between two messages
const MOST = 500; // points in a message

let library = null;
let loaded = null; // settles when the library is there
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
    postMessage({ kind: "ready", module: made });
  },

  gears({ settings }) {
    const surfaces = [0, 1].map((gear) => library.gear(settings, gear));
    postMessage({ kind: "gears", surfaces });
  },

  async run({ number, scene, references }) {
    current = number;
    postMessage({ kind: "taken", number });
    const run = new Run(library, scene);
    const warnings = library.said().filter(({ status }) => status > 0).map(({ text }) => text);
    postMessage({ kind: "started", number, warnings });
    let busy = 0;
    const width = references.length + 1;
    const points = new Float64Array(width * MOST);
    let count = 0;
    const reader = library.reader(references);
    const note = () => {
      points[width * count] = run.time;
      reader.read(points, width * count + 1);
      count += 1;
    };
    try {
      note();
      while (current === number) {
        const begin = performance.now();
        while (!run.isOver && count < MOST && performance.now() - begin < BATCH) {
          run.advance();
          note();
        }
        busy += performance.now() - begin;
        const part = points.slice(0, width * count);
        postMessage({ kind: "points", number, points: part, time: run.time, seconds: busy / 1e3 }, [part.buffer]);
        count = 0;
        if (run.isOver) break;
        await pause();
      }
    } finally {
      reader.free();
    }
    if (current === number) postMessage({ kind: "over", number, said: library.said().map(({ text }) => text) });
  },
};

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
