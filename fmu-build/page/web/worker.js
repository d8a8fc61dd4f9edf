// The worker: it owns the library, runs scenes and makes surfaces of gears. It answers every request with messages.
import { Library, Refused } from "./library.js";
import { Run } from "./run.js";

const BATCH = 30; // ms of simulation between two messages

let library = null;
let current = 0; // number of the run that is wanted

// Lets messages in.
const pause = () => new Promise((resolve) => {
  const { port1, port2 } = new MessageChannel();
  port1.onmessage = () => resolve(port1.close());
  port2.postMessage(null);
});

const requests = {
  async load({ bytes }) {
    library = await Library.of(await WebAssembly.compile(bytes));
    postMessage({ kind: "ready" });
  },

  gears({ number, settings }) {
    const surfaces = [0, 1].map((gear) => library.gear(settings, gear));
    postMessage({ kind: "gears", number, surfaces });
  },

  async run({ number, scene, references, constants }) {
    current = number;
    const started = performance.now();
    const run = new Run(library, scene);
    const values = library.get(constants);
    const warnings = library.said().filter(({ status }) => status > 0).map(({ text }) => text);
    postMessage({ kind: "started", number, values, warnings, seconds: (performance.now() - started) / 1e3 });
    let busy = 0;
    let rows = [[0, ...library.get(references)]];
    while (current === number) {
      const begin = performance.now();
      while (!run.isOver && performance.now() - begin < BATCH) {
        run.advance();
        rows.push([run.time, ...library.get(references)]);
      }
      busy += performance.now() - begin;
      const points = new Float64Array(rows.flat());
      postMessage({ kind: "points", number, points, time: run.time, seconds: busy / 1e3 }, [points.buffer]);
      rows = [];
      if (run.isOver) break;
      await pause();
    }
    if (current === number) postMessage({ kind: "over", number, said: library.said().map(({ text }) => text) });
  },

  stop() {
    current = 0;
  },
};

onmessage = async ({ data }) => {
  try {
    await requests[data.kind](data);
  } catch (error) {
    // a trap leaves the library in no state to go on
    const kind = error instanceof Refused ? "refused" : "trap";
    postMessage({ kind, number: data.number, text: String(error.message ?? error) });
  }
};
