// browser.mjs PAGE_FOLDER CONFORMANCE_FOLDER: the built page in Debian's chromium, without a GPU. Exits with 77 where
// there is no browser or playwright-core to drive it with. SCREENSHOTS names a folder to leave pictures in; TVG_TOOL the
// native tool, whose pictures the page's are compared with.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { hasChromium, launch } from "./chromium.mjs";
import { liveAnswer, servePage } from "./page_server.mjs";

const [folder, conformance] = process.argv.slice(2);
if (!hasChromium || !existsSync(join(folder, "player.js"))) {
  console.log("skipped: needs chromium, playwright-core (npm ci in web/) and the built page");
  process.exit(77);
}

const streamBytes = (name) => readFileSync(join(conformance, `${name}.tvg`));
const whole = streamBytes("gops");
const server = await servePage(folder, { "clip.tvg": whole });
const browser = await launch();
const complaints = [];
const passed = (text) => console.log(`ok ${text}`);

async function open(query = "", options = {}) {
  const page = await browser.newPage({ viewport: { width: 800, height: 560 }, ...options });
  page.setDefaultTimeout(60000);
  page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(String(error)));
  await page.goto(server.url + query);
  return page;
}
/** Opens the page, uses it, and closes it. */
async function visit(use, query, options) {
  const page = await open(query, options);
  try {
    await use(page);
  } finally {
    await page.close();
  }
}
const picture = async (page, name) => {
  if (process.env.SCREENSHOTS) await page.screenshot({ path: join(process.env.SCREENSHOTS, `${name}.png`) });
};
const plays = (page, frame = 3) => page.waitForFunction((number) => tvgPlayer.frame?.number > number, frame);
async function goTo(page, frame) {
  await page.fill("#scrub", String(frame));
  await page.waitForFunction((wanted) => !tvgPlayer.seeking && tvgPlayer.frame.number === wanted, frame);
}
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

async function playing(page) {
  await plays(page);
  passed("it plays by itself");
  const drawn = await page.locator("#view").screenshot();
  await page.focus("#view");
  await page.keyboard.press("k");
  assert.ok(await page.evaluate(() => tvgPlayer.paused));
  await goTo(page, 4);
  passed("it goes where the bar is put");
  const shown = await page.evaluate(() => Array.from(new Uint32Array(tvgPlayer.frame.positions.buffer)));
  assert.deepEqual(shown, await frameInNode(4));
  passed("its frame is Node's, bit for bit");
  await page.waitForTimeout(300);
  assert.ok(!drawn.equals(await page.locator("#view").screenshot()), "two frames look the same");
  passed("what it draws changes with the frame");
  await page.focus("#view");
  await page.keyboard.press(".");
  await page.waitForFunction(() => tvgPlayer.frame.number === 5);
  passed("keys step through frames");
  await page.waitForSelector("#buffered i");
  passed("the bar shows what is there");
  const requests = server.requests.length;
  await page.keyboard.press("k");
  await page.waitForFunction(() => tvgPlayer.frame.lap > 1);
  assert.equal(server.requests.length, requests, "what is there is fetched again");
  passed("it loops without fetching anything again");
}

/** Bytes that the page holds once what is not needed is gone: of scripts and of their arrays. */
async function heldBytes(page, session) {
  await session.send("HeapProfiler.collectGarbage");
  return page.evaluate(() => performance.memory.usedJSHeapSize);
}

async function looping(page) {
  await plays(page);
  await page.evaluate(() => (tvgPlayer.playbackRate = 4));
  const session = await page.context().newCDPSession(page);
  await session.send("HeapProfiler.enable");
  const lap = (number) => page.waitForFunction((least) => tvgPlayer.frame.lap >= least, number);
  await lap(4);
  const before = await heldBytes(page, session);
  await lap(24);
  const after = await heldBytes(page, session);
  assert.ok(after - before < 2e6, `it holds ${after - before} bytes more`);
  passed("20 loops leave nothing behind");
}

async function cut(page) {
  await plays(page, 5);
  assert.ok(server.cuts <= 0);
  passed("a connection that is cut is taken up again");
}

async function damaged(page) {
  await page.waitForSelector("#status:has-text('Damaged')");
  passed("it tells of damage");
}

async function broken(page) {
  await page.waitForSelector("#trouble:not([hidden])");
  passed("it tells what cannot be played");
  await picture(page, "error");
  server.files["clip.tvg"] = whole;
  await page.click("#retry");
  await plays(page);
  assert.ok(await page.isHidden("#trouble"));
  passed("it plays when it is tried again and there is something to play");
}

async function important(page) {
  await plays(page, 1);
  await page.click("#importance");
  await page.waitForFunction(() => tvgMesh.importance && tvgMesh.geometry.getAttribute("color"));
  passed("it colours important vertices");
}

async function live(page) {
  await plays(page);
  await page.waitForSelector("#live.now");
  await page.waitForFunction(() => /s behind/.test(document.getElementById("time").value));
  await page.click("#play");
  await page.waitForFunction(() => tvgPlayer.behind > 3);
  await picture(page, "live");
  await page.click("#live");
  await page.waitForSelector("#live.now");
  passed("a live stream plays, and who fell behind comes back to it");
}

async function liveEnd(page) {
  await page.waitForSelector("#trouble:has-text('has ended')");
  passed("it tells that a live stream has ended");
}

/** The share of points of which only one of two pictures is of the mesh; their backgrounds are white. */
async function difference(page, one, other) {
  return page.evaluate(async (files) => {
    const masks = await Promise.all(
      files.map(async (file) => {
        const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${file}`)).blob());
        const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
        context.drawImage(bitmap, 0, 0);
        const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
        return Array.from({ length: data.length / 4 }, (_, i) => data[4 * i] + data[4 * i + 1] + data[4 * i + 2] < 720);
      }),
    );
    const area = masks[1].filter(Boolean).length;
    return { area, share: masks[0].filter((is, i) => is !== masks[1][i]).length / area };
  }, [one, other].map((file) => file.toString("base64")));
}

/** The page's picture of a frame beside the tool's. */
async function compared(page) {
  await plays(page, 1);
  await page.click("#play");
  await goTo(page, 0);
  await page.addStyleTag({ content: "#player { background: #fff !important } #bar, #title, #status, #loading { display: none !important }" });
  // As the tool frames a single picture: by the box itself.
  await page.evaluate(() => (tvgStage.bottom = 0));
  await page.evaluate(() => tvgStage.fit(tvgPlayer.metadata.get("up") === "z", 0));
  await page.waitForTimeout(500);
  const shot = await page.screenshot();
  const output = mkdtempSync(join(tmpdir(), "tvg-render-"));
  try {
    const file = join(output, "a.png");
    const stream = join(conformance, "gops.tvg");
    execFileSync(process.env.TVG_TOOL, ["render", stream, "--frames", "0", "-o", file, "--size", "800x560", "--background", "white", "--no-labels", "-q"]);
    const { area, share } = await difference(page, shot, readFileSync(file));
    assert.ok(area > 20000 && share < 0.03, `${share} of ${area} points`);
    passed(`its picture is tvg render's but for ${(100 * share).toFixed(2)} % of its points`);
  } finally {
    rmSync(output, { recursive: true, force: true });
  }
}

async function withLadder(page) {
  await plays(page);
  await page.waitForFunction(() => tvgPlayer.progress?.stream === 0);
  passed("it plays a ladder");
}

try {
  await visit(playing);
  await visit((page) => plays(page).then(() => picture(page, "light")));
  await visit((page) => plays(page).then(() => picture(page, "dark")), "", { colorScheme: "dark" });
  await visit((page) => plays(page).then(() => picture(page, "phone")), "", { viewport: { width: 360, height: 640 } });
  await visit(looping);
  if (process.env.TVG_TOOL) await visit(compared);
  else console.log("skipped: TVG_TOOL names no tool to compare pictures with");

  const rung = { file: "clip.tvg", bits_per_second: 1000 };
  server.files["ladder.json"] = JSON.stringify({ tvg_ladder: 1, frame_rate: 30, frame_count: 7, period_frames: 2, streams: [rung] });
  server.files["ladder.json"] = Buffer.from(server.files["ladder.json"]);
  await visit(withLadder, "?stream=ladder.json");
  server.files["clip.tvg"] = streamBytes("hybrid");
  await visit(important);

  server.live = liveAnswer(whole, { seconds: 0.06 });
  await visit(live, "?live=dance", { colorScheme: "dark" });
  server.live = liveAnswer(whole, { seconds: 0.06, groups: 4 });
  await visit(liveEnd, "?live=dance");

  server.files["clip.tvg"] = Buffer.from(whole);
  server.files["clip.tvg"][Math.floor(whole.length * 0.8)] ^= 1;
  await visit(damaged);
  assert.deepEqual(complaints.splice(0), [], "the console has errors");
  passed("nothing is wrong in the console");

  server.files["clip.tvg"] = whole;
  Object.assign(server, { cutAfter: 400, cuts: 2 });
  await visit(cut);
  server.files["clip.tvg"] = Buffer.alloc(100);
  await visit(broken);
} finally {
  await browser.close();
  await server.close();
}
