// Runs in the page before its program: in the first worker fmi2DoStep traps from the second run on. The page's own library is left
// alone: the function is exchanged where the worker makes an instance of it.
const Whole = Blob;
const program = [];
window.Blob = class extends Whole {
  constructor(parts, options) {
    super(parts, options);
    if (options?.type === "text/javascript") program.push(...parts);
  }
};

function trapping() {
  let runs = 0;
  addEventListener("message", ({ data }) => { runs += data.kind === "run"; });
  // (module (func (export "trap") (param i32 f64 f64 i32) (result i32) unreachable))
  const bytes = [0, 97, 115, 109, 1, 0, 0, 0, 1, 9, 1, 96, 4, 127, 124, 124, 127, 1, 127, 3, 2, 1, 0, 7, 8, 1, 4, 116, 114, 97, 112,
    0, 0, 10, 5, 1, 3, 0, 0, 11];
  const { trap } = new WebAssembly.Instance(new WebAssembly.Module(new Uint8Array(bytes))).exports;
  const instantiate = WebAssembly.instantiate;
  WebAssembly.instantiate = async (...all) => {
    const made = await instantiate(...all);
    const { exports } = made;
    // what unpacks the library is of WebAssembly, too
    if (!exports?.fmi2DoStep) return made;
    const step = (...values) => (runs > 1 ? trap : exports.fmi2DoStep)(...values);
    return { exports: { ...exports, fmi2DoStep: step } };
  };
}

let workers = 0;
window.Worker = class extends Worker {
  constructor(address) {
    workers += 1;
    super(workers > 1 ? address : URL.createObjectURL(new Whole([`(${trapping})();`, ...program], { type: "text/javascript" })));
  }
};
