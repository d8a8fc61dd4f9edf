// Runs scenes in node with the programs of the page: node runner.mjs WEB LIBRARY.wasm SCENES.json OUT.json
//
// WEB is the folder with library.js. SCENES contains {name: {scene, references}} as the page sends them to its worker. OUT
// receives {name: rows}. Each number is written as 16 hexadecimal digits.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [web, file, scenes, out] = process.argv.slice(2);
const { Library, Run } = await import(pathToFileURL(join(web, "library.js")));
const compiled = await WebAssembly.compile(readFileSync(file));

const view = new DataView(new ArrayBuffer(8));
function bits(number) {
  view.setFloat64(0, number);
  return view.getBigUint64(0).toString(16).padStart(16, "0");
}

const records = {};
for (const [name, { scene, references }] of Object.entries(JSON.parse(readFileSync(scenes, "utf8")))) {
  const library = await Library.of(compiled);
  const run = new Run(library, scene);
  const reader = library.reader(references);
  const values = new Float64Array(references.length);
  const row = () => {
    reader.read(values, 0);
    return [run.time, ...values].map(bits);
  };
  const rows = [row()];
  while (!run.isOver) {
    run.advance();
    rows.push(row());
  }
  records[name] = rows;
}
writeFileSync(out, JSON.stringify(records));
