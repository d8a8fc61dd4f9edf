// A step that traps, like a library after an internal failure.
window.failure = (...values) => {
  // (module (func (export "trap") (param i32 f64 f64 i32) (result i32) unreachable))
  const bytes = [0, 97, 115, 109, 1, 0, 0, 0, 1, 9, 1, 96, 4, 127, 124, 124, 127, 1, 127, 3, 2, 1, 0, 7, 8, 1, 4, 116, 114, 97, 112,
    0, 0, 10, 5, 1, 3, 0, 0, 11];
  const { trap } = new WebAssembly.Instance(new WebAssembly.Module(new Uint8Array(bytes))).exports;
  return trap(...values);
};
