// build_page.mjs FOLDER TVG.WASM: puts the page of `tvg page` together in FOLDER, and the package's worker into one file
// beside it. Needs `npm ci` here.
import { build } from "esbuild";
import { copyFileSync, mkdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const [folder, wasm] = process.argv.slice(2);
const home = dirname(fileURLToPath(import.meta.url));
const common = { bundle: true, minify: true, target: "es2022", format: "iife", logLevel: "warning", define: { "import.meta.url": "document.baseURI" } };
const worker = await build({
  ...common,
  entryPoints: [join(home, "src/worker.ts")],
  write: false,
  define: { "import.meta.url": "self.location.href" },
});
// The package's worker in one file: its modules by themselves would be fetched one after another.
await build({ ...common, define: {}, format: "esm", entryPoints: [join(home, "src/worker.ts")], outfile: join(folder, "../dist/worker.js") });
mkdirSync(folder, { recursive: true });
await build({
  ...common,
  entryPoints: [join(home, "page/player.ts")],
  outfile: join(folder, "player.js"),
  legalComments: "inline",
  define: { ...common.define, WORKER_SCRIPT: JSON.stringify(worker.outputFiles[0].text) },
});
for (const name of ["index.html", "player.css"]) copyFileSync(join(home, "page", name), join(folder, name));
copyFileSync(wasm, join(folder, "tvg.wasm"));
