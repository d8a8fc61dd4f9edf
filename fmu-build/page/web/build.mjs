// Builds the page as one HTML file: node build.mjs LIBRARY.wasm.xz DATA.json OUT.html
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const HERE = dirname(fileURLToPath(import.meta.url));
const MOST = 3e6; // maximum size of the page in bytes
const PACKAGES = ["three", "uplot", "xz-decompress"];
const COMMON = { bundle: true, minify: true, format: "iife", target: "es2022", write: false, legalComments: "none" };

const own = (file) => readFileSync(join(HERE, file), "utf8");
const packed = (bytes) => gzipSync(bytes, { level: 9 }).toString("base64");
// text inside a style must not end the style element
const asStyle = (text) => text.replaceAll("</style", "<\\/style");
const asHtml = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");

// `import text from "worker:FILE"` returns the whole program of a worker as text.
const workers = {
  name: "workers",
  setup(bundler) {
    bundler.onResolve({ filter: /^worker:/ }, ({ path }) => ({ path: join(HERE, path.slice(7)), namespace: "worker" }));
    bundler.onLoad({ filter: /.*/, namespace: "worker" }, async ({ path }) => {
      const { outputFiles } = await build({ ...COMMON, entryPoints: [path] });
      return { contents: outputFiles[0].text, loader: "text" };
    });
  },
};

async function main([library, data, out]) {
  if (!out) throw new Error("usage: node build.mjs LIBRARY.wasm.xz DATA.json OUT.html");
  const { outputFiles } = await build({ ...COMMON, entryPoints: [join(HERE, "page.js")], plugins: [workers] });
  const licences = PACKAGES.map((name) => {
    const { version, license, author } = JSON.parse(own(`node_modules/${name}/package.json`));
    const file = `node_modules/${name}/LICENSE`;
    const text = existsSync(join(HERE, file)) ? own(file).trim() : `Licence: ${license}, ${author}`;
    return `${name} ${version}\n\n${text}`;
  });
  const known = JSON.parse(readFileSync(data, "utf8"));
  const parts = {
    guid: known.guid,
    style: asStyle(own("node_modules/uplot/dist/uPlot.min.css") + own("style.css")),
    licences: asHtml(licences.join("\n\n\n")),
    data: packed(JSON.stringify(known)),
    // its code has repetitions at distances larger than the window of gzip
    library: readFileSync(library).toString("base64"),
    program: packed(outputFiles[0].text),
  };
  const page = own("index.html").replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
  writeFileSync(out, page);
  const bytes = Buffer.byteLength(page);
  const sizes = Object.entries(parts).map(([name, text]) => `${name} ${Math.round(Buffer.byteLength(text) / 1e3)}`);
  console.log(`${out}: ${Math.round(bytes / 1e3)} kB (${sizes.join(", ")})`);
  if (bytes > MOST) throw new Error(`the page has ${bytes} bytes, more than ${MOST}`);
}

main(process.argv.slice(2)).catch((error) => {
  console.error(error.message);
  process.exitCode = 1;
});
