// Frames that the GPU makes, in Debian's chromium without a GPU, against those of the CPU.
import assert from "node:assert/strict";
import { cpSync, existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { hasChromium, launch } from "./chromium.mjs";
import { packageFolder } from "./toolbox.mjs";

const web = fileURLToPath(new URL("..", import.meta.url));
const hasThree = existsSync(join(web, "node_modules/three")) && existsSync(join(packageFolder, "dist/three/index.js"));
const skip = !hasThree ? "npm ci was not run in web/" : !hasChromium ? "there is no chromium" : false;

const kMap = `<script type="importmap">{ "imports": {
  "three": "./node_modules/three/build/three.module.js",
  "tvg": "./node_modules/tvg/dist/index.js",
  "tvg/three": "./node_modules/tvg/dist/three/index.js" } }</script>`;
const kPage = `<!doctype html><link rel="icon" href="data:,">${kMap}<script type="module" src="gpu_page.js"></script>`;

const folder = mkdtempSync(join(tmpdir(), "tvg-gpu-"));
const types = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm" };
const server = createServer((request, response) => {
  const file = join(folder, new URL(request.url, "http://localhost").pathname);
  if (!existsSync(file)) return response.writeHead(404).end();
  const body = readFileSync(file);
  const range = /^bytes=(\d+)-(\d*)$/.exec(request.headers.range ?? "");
  const from = range ? Number(range[1]) : 0;
  const to = range?.[2] ? Number(range[2]) + 1 : body.length;
  const headers = { "Content-Type": types[extname(file)] ?? "application/octet-stream" };
  if (range) headers["Content-Range"] = `bytes ${from}-${to - 1}/${body.length}`;
  response.writeHead(range ? 206 : 200, headers).end(body.subarray(from, to));
});
let browser;
const complaints = [];
const hasSheet = process.env.TVG_GPU_SHEET !== undefined;

before(async () => {
  if (skip) return;
  cpSync(join(web, "examples/webgl2"), folder, { recursive: true });
  cpSync(join(web, "test/gpu_page.js"), join(folder, "gpu_page.js"));
  cpSync(packageFolder, join(folder, "node_modules/tvg"), { recursive: true, filter: (path) => !path.endsWith("/page") });
  symlinkSync(join(web, "node_modules/three"), join(folder, "node_modules/three"));
  for (const name of readdirSync(process.env.TVG_CONFORMANCE)) {
    if (name.endsWith(".tvg")) cpSync(join(process.env.TVG_CONFORMANCE, name), join(folder, name));
  }
  if (hasSheet) cpSync(process.env.TVG_GPU_SHEET, join(folder, "sheet.tvg"));
  writeFileSync(join(folder, "gpu.html"), kPage);
  // What reads its positions back wants three.js too.
  const example = readFileSync(join(folder, "index.html"), "utf8");
  writeFileSync(join(folder, "index.html"), example.replace(/<script type="importmap">[^]*?<\/script>/, kMap));
  await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
  browser = await launch();
});
after(async () => {
  await browser?.close();
  server.close();
  rmSync(folder, { recursive: true, force: true });
});

async function open(path) {
  const page = await browser.newPage({ viewport: { width: 480, height: 360 } });
  page.setDefaultTimeout(60000);
  page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(String(error)));
  await page.goto(`http://127.0.0.1:${server.address().port}/${path}`);
  return page;
}

for (const [name, hasSeam] of [["basis"], ["basis", true], ["basis_hybrid"], ["basis_error"], ["basis_and_elp"], ["lods_basis"]]) {
  test(`three.js draws ${name}${hasSeam ? ", cut in two," : ""} from planes as from positions`, { skip }, async (context) => {
    const page = await open("gpu.html");
    await page.waitForFunction(() => globalThis.compare);
    const { frames, made, worst, pixels, brightness } = await page.evaluate((of) => compare(...of), [`${name}.tvg`, hasSeam]);
    await page.close();
    assert.ok(frames > 3 && made > 0 && (made === frames) === (name !== "basis_and_elp"), `${made} of ${frames}`);
    context.diagnostic(`${worst.toFixed(2)} of the bound, pictures ${pixels.toFixed(4)} of 255 apart`);
    assert.ok(worst <= 1, `${worst} of the bound`);
    assert.ok(brightness > 0.5, `there is something in the picture: ${brightness}`);
    assert.ok(pixels < 1, `pictures differ by ${pixels} of 255`);
    assert.deepEqual(complaints, []);
  });
}

test("what is no WebGL2 renderer gets positions", { skip }, async () => {
  const page = await open("gpu.html");
  await page.waitForFunction(() => globalThis.compare);
  assert.deepEqual(await page.evaluate(() => fallBack("basis.tvg")), { used: false, rows: false, positions: true });
  await page.close();
  assert.deepEqual(complaints, []);
});

test("shadows of suns and lamps and wires follow what the GPU makes", { skip }, async () => {
  const page = await open("gpu.html");
  await page.waitForFunction(() => globalThis.compare);
  const { pixels, shadow } = await page.evaluate(() => compareShadows("basis.tvg"));
  await page.close();
  assert.ok(shadow > 0.2, `a shadow changes the picture by ${shadow}`);
  assert.ok(pixels < 1, `pictures differ by ${pixels} of 255`);
  assert.deepEqual(complaints, []);
});

test("the example for plain WebGL2 makes the positions", { skip }, async () => {
  const page = await open("index.html?stream=basis.tvg");
  await page.waitForFunction(() => globalThis.player?.frame?.number > 3);
  const { rows, worst } = await page.evaluate(() => import("./gpu_page.js").then(({ readBack }) => readBack(player, gl)));
  await page.close();
  assert.ok(rows && worst <= 1, `${worst} of the bound`);
  assert.deepEqual(complaints, []);
});

test("figures: a frame of 100,000 vertices", { skip: skip || (!hasSheet && "TVG_GPU_SHEET names no stream") }, async (context) => {
  const page = await open("gpu.html");
  await page.waitForFunction(() => globalThis.compare);
  for (const stream of ["basis.tvg", "sheet.tvg"]) {
    context.diagnostic(`${stream}: ${JSON.stringify(await page.evaluate((name) => measureTake(name), stream))}`);
  }
  context.diagnostic(JSON.stringify(await page.evaluate(() => measure("sheet.tvg"))));
  await page.close();
});
