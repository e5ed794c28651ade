// compare.mjs TVG_TOOL PACKAGE MESH CACHE: one animation on a web page in five ways, in one run of chromium: a stream in
// mode elp, and in mode basis made by the CPU and by the GPU; a Draco file for each frame (three's DRACOLoader); and a glTF
// whose frames are morph targets, packed with meshopt. Needs chromium, npm ci in web/, Debian's draco, and gltfpack (npx
// takes it from npm).
import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, symlinkSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { chromium } from "playwright-core";

const [tool, packageFolder, mesh, cache] = process.argv.slice(2);
if (!cache) throw new Error("usage: node compare.mjs TVG_TOOL PACKAGE MESH CACHE");
const kBits = "12";
const kLine = { megabits: 10, latencyMs: 20 };
const web = fileURLToPath(new URL("..", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "tvg-compare-"));
const run = (program, ...args) => execFileSync(program, args, { cwd: folder, stdio: ["ignore", "pipe", "inherit"] });
const sizeOf = (name) => statSync(join(folder, name)).size;

/** All have positions on 12 bits of the same box. */
function makeFiles() {
  const input = [resolve(mesh), resolve(cache)];
  run(tool, "encode", ...input, "-o", "elp.tvg", "--bits", kBits, "-q");
  run(tool, "encode", ...input, "-o", "basis.tvg", "--bits", kBits, "--mode", "basis", "-q");
  run(tool, "decode", "elp.tvg", "-o", "whole.glb", "-q");
  run("npx", "--yes", "gltfpack", "-i", "whole.glb", "-o", "morph.glb", "-cc", "-vp", kBits, "-af", "0");
  mkdirSync(join(folder, "frames"));
  run(tool, "decode", "elp.tvg", "-o", "frames/%05d.obj", "-q");
  for (const name of readdirSync(join(folder, "frames"))) {
    run("draco_encoder", "-i", `frames/${name}`, "-o", `frames/${name.replace(".obj", ".drc")}`, "-qp", kBits);
  }
  return readdirSync(join(folder, "frames")).filter((name) => name.endsWith(".drc")).map((name) => `frames/${name}`);
}

const types = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm" };
const server = createServer((request, response) => {
  const file = join(folder, new URL(request.url, "http://localhost").pathname);
  if (!existsSync(file) || !statSync(file).isFile()) return response.writeHead(404).end();
  const body = readFileSync(file);
  const range = /^bytes=(\d+)-(\d*)$/.exec(request.headers.range ?? "");
  const [from, to] = range ? [Number(range[1]), range[2] ? Number(range[2]) + 1 : body.length] : [0, body.length];
  const headers = { "Content-Type": types[extname(file)] ?? "application/octet-stream", "Content-Length": to - from };
  if (range) headers["Content-Range"] = `bytes ${from}-${to - 1}/${body.length}`;
  // As servers are set up: scripts and modules compressed, what is compressed already as it is.
  if (!range && types[extname(file)]) {
    const packed = gzipSync(body);
    const headersOfPacked = { ...headers, "Content-Length": packed.length, "Content-Encoding": "gzip" };
    return response.writeHead(200, headersOfPacked).end(packed);
  }
  response.writeHead(range ? 206 : 200, headers).end(body.subarray(from, to));
});

async function measure(browser, url, way, frames, slow) {
  const page = await browser.newPage();
  page.on("pageerror", (error) => console.error(way, String(error)));
  await page.goto(url);
  await page.waitForFunction(() => globalThis.measure);
  if (slow) {
    const line = await page.context().newCDPSession(page);
    const throughput = (kLine.megabits * 1e6) / 8;
    await line.send("Network.enable");
    await line.send("Network.emulateNetworkConditions", {
      offline: false, latency: kLine.latencyMs, downloadThroughput: throughput, uploadThroughput: throughput,
    });
  }
  const figures = await page.evaluate(([way, frames, slow]) => globalThis.measure(way, frames, slow), [way, frames, slow]);
  await page.close();
  return figures;
}

try {
  const frames = makeFiles();
  symlinkSync(join(web, "node_modules"), join(folder, "node_modules"));
  cpSync(packageFolder, join(folder, "tvg"), { recursive: true });
  for (const name of ["compare.html", "compare_page.js"]) cpSync(join(web, "bench", name), join(folder, name));
  await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
  const url = `http://127.0.0.1:${server.address().port}/compare.html`;
  const browser = await chromium.launch({
    executablePath: "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
  });
  const sizes = {
    elp: sizeOf("elp.tvg"),
    basis: sizeOf("basis.tvg"),
    "basis on the GPU": sizeOf("basis.tvg"),
    draco: frames.reduce((sum, name) => sum + sizeOf(name), 0),
    morph: sizeOf("morph.glb"),
  };
  console.log(`${frames.length} frames; ${kLine.megabits} Mbit/s, ${kLine.latencyMs} ms\n`);
  console.log("| | bytes | first frame, ms | decoding a frame, ms | main thread a frame, ms |\n|---|--:|--:|--:|--:|");
  for (const way of Object.keys(sizes)) {
    const first = await measure(browser, url, way, frames, true);
    const steady = await measure(browser, url, way, frames, false);
    const row = [way, sizes[way], first.firstFrame.toFixed(0), steady.decoding.toFixed(2), steady.mainThread.toFixed(3)];
    console.log(`| ${row.join(" | ")} |`);
  }
  await browser.close();
} finally {
  server.close();
  rmSync(folder, { recursive: true, force: true });
}
