// Runs in the page before its program. From the second run on, `window.failure` replaces fmi2DoStep in the first worker. The library in the
// page is unchanged, because the function is replaced when the worker instantiates the library. The next script defines `window.failure`.
const Whole = Blob;
const program = [];
window.Blob = class extends Whole {
  constructor(parts, options) {
    super(parts, options);
    if (options?.type === "text/javascript") program.push(...parts);
  }
};

function exchange(fails) {
  let runs = 0;
  addEventListener("message", ({ data }) => { runs += data.kind === "run"; });
  const instantiate = WebAssembly.instantiate;
  WebAssembly.instantiate = async (...all) => {
    const made = await instantiate(...all);
    const { exports } = made;
    // the decompressor of the library is also a WebAssembly module
    if (!exports?.fmi2DoStep) return made;
    const step = (...values) => (runs > 1 ? fails : exports.fmi2DoStep)(...values);
    return { exports: { ...exports, fmi2DoStep: step } };
  };
}

let workers = 0;
window.Worker = class extends Worker {
  constructor(address) {
    workers += 1;
    const first = () => URL.createObjectURL(new Whole([`(${exchange})(${window.failure});`, ...program], { type: "text/javascript" }));
    super(workers > 1 ? address : first());
  }
};
