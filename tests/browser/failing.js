// Runs in the page before its program: from the second run on, a failure stands for fmi2DoStep in the first worker. The page's own library
// is left alone: the function is exchanged where the worker makes an instance of it. The script that comes next gives
// `window.failure`.
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
    // what unpacks the library is of WebAssembly, too
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
