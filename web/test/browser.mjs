// browser.mjs PAGE_FOLDER STREAM: plays a stream in the built page in Debian's chromium, without a GPU. Exits with 77
// where there is no browser or playwright-core to drive it with. SCREENSHOTS names a folder to leave pictures in.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, streamFile] = process.argv.slice(2);
const browserPath = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
const { chromium } = await import("playwright-core").catch(() => ({}));
if (!browserPath || !chromium || !existsSync(join(folder, "player.js"))) {
  console.log("skipped: needs chromium, playwright-core (npm ci in web/) and the built page");
  process.exit(77);
}

const types = { html: "text/html", js: "text/javascript", css: "text/css", wasm: "application/wasm", tvg: "model/x-tvg" };
const whole = readFileSync(streamFile);
const broken = Buffer.from(whole);
broken[Math.floor(broken.length * 0.8)] ^= 1;
let stream = whole;
const server = createServer((request, response) => {
  const name = request.url === "/" ? "index.html" : request.url.slice(1);
  const file = join(folder, name);
  const body = name === "clip.tvg" ? stream : existsSync(file) ? readFileSync(file) : undefined;
  if (!body) return response.writeHead(404).end();
  const range = /^bytes=(\d+)-(\d*)$/.exec(request.headers.range ?? "");
  const from = range ? Number(range[1]) : 0;
  const to = range?.[2] ? Number(range[2]) + 1 : body.length;
  const headers = { "Content-Type": types[name.split(".").pop()], "Content-Length": to - from };
  if (range) headers["Content-Range"] = `bytes ${from}-${to - 1}/${body.length}`;
  response.writeHead(range ? 206 : 200, headers).end(body.subarray(from, to));
});
await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
const url = `http://127.0.0.1:${server.address().port}/`;

const browser = await chromium.launch({
  executablePath: browserPath,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});
const complaints = [];
async function open(options = {}) {
  const page = await browser.newPage({ viewport: { width: 800, height: 560 }, ...options });
  page.setDefaultTimeout(60000);
  page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(String(error)));
  await page.goto(url);
  return page;
}
const picture = async (page, name) => {
  if (process.env.SCREENSHOTS) await page.screenshot({ path: join(process.env.SCREENSHOTS, `${name}.png`) });
};
/** The bits of a frame's positions as the package decodes them here. */
async function frameInNode(number) {
  const { TvgStream } = await import(pathToFileURL(join(folder, "../dist/index.js")).href);
  const decoded = await TvgStream.open(new Uint8Array(whole));
  decoded.seek(number);
  while ((await decoded.next()) !== "frame");
  const positions = new Float32Array(3 * decoded.decoder.view().vertexCount);
  decoded.decoder.copyViewPositions(positions);
  decoded.dispose();
  return Array.from(new Uint32Array(positions.buffer));
}
const passed = (text) => console.log(`ok ${text}`);

try {
  let page = await open();
  await page.waitForFunction(() => tvgPlayer.frame?.number > 3);
  passed("it plays by itself");
  const drawn = await page.locator("#view").screenshot();
  const frames = await page.evaluate(() => Math.round(tvgPlayer.duration * tvgPlayer.frameRate));
  
  await page.focus("#view");
  await page.keyboard.press("k");
  assert.ok(await page.evaluate(() => tvgPlayer.paused));
  await page.fill("#scrub", String(frames - 3));
  await page.waitForFunction((frame) => !tvgPlayer.seeking && tvgPlayer.frame.number === frame, frames - 3);
  passed("it goes where the bar is put");
  const shown = await page.evaluate(() => Array.from(new Uint32Array(tvgPlayer.frame.positions.buffer)));
  assert.deepEqual(shown, await frameInNode(frames - 3));
  passed("its frame is Node's, bit for bit");
  await page.waitForTimeout(300);
  assert.ok(!drawn.equals(await page.locator("#view").screenshot()), "two frames look the same");
  passed("what it draws changes with the frame");
  await picture(page, "light");
  await page.focus("#view");
  await page.keyboard.press(".");
  await page.waitForFunction((frame) => tvgPlayer.frame.number === frame, frames - 2);
  passed("keys step through frames");
  await page.keyboard.press("k");
  await page.waitForFunction(() => tvgPlayer.frame.lap > 0);
  passed("it loops");
  await page.close();

  page = await open({ colorScheme: "dark" });
  await page.waitForFunction(() => tvgPlayer.frame?.number > 3);
  await page.check("#wire");
  await page.waitForTimeout(300);
  await picture(page, "dark");
  await page.close();

  stream = broken;
  page = await open();
  await page.waitForSelector("#status:has-text('Damaged')");
  passed("it tells of damage");
  await page.close();
  assert.deepEqual(complaints, [], "the console has errors");
  passed("nothing is wrong in the console");

  stream = Buffer.alloc(100);
  page = await open();
  await page.waitForSelector("#status.error");
  passed("it tells what cannot be played");
  await picture(page, "error");
} finally {
  await browser.close();
  server.close();
}
