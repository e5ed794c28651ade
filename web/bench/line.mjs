// line.mjs PAGE_FOLDER STREAM [MEGABITS]: how the page plays a stream over a line of 10 Mbit/s with 20 ms of latency:
// milliseconds to the first frame, from the page's address on and from the stream's, for 20 seeks to anywhere, and stalls
// while it plays for as long as the stream should take, at most 60 s. Needs chromium and npm ci in web/.
import { readFileSync } from "node:fs";
import { launch } from "../test/chromium.mjs";
import { servePage } from "../test/page_server.mjs";

const [folder, file, megabits = "10"] = process.argv.slice(2);
if (!file) throw new Error("usage: node line.mjs PAGE_FOLDER STREAM [MEGABITS]");
const kSeeks = 20;
const stream = readFileSync(file);
const server = await servePage(folder, { "clip.tvg": stream });
server.latency = 20;
server.bytesPerSecond = (Number(megabits) * 1e6) / 8;
const browser = await launch();

/** Opens the page; what is told of its first frame is when it came, and how long after the stream was asked for. */
async function open() {
  const page = await browser.newPage({ viewport: { width: 480, height: 360 } });
  page.setDefaultTimeout(120000);
  await page.goto(server.url);
  await page.waitForFunction(() => globalThis.tvgPlayer?.frame);
  const [opened, asked] = await page.evaluate(() => {
    const requests = performance.getEntriesByName(new URL("clip.tvg", document.baseURI).href);
    return [performance.now(), requests[0]?.startTime ?? NaN];
  });
  return { page, opened, asked };
}

try {
  const { page, opened } = await open();
  console.log(`${(stream.length / 1e6).toFixed(1)} MB, ${megabits} Mbit/s`);
  console.log(`first frame, player and decoder fetched too: ${opened.toFixed(0)} ms`);
  const first = await page.evaluate(async () => {
    // The player is there, and what it has of the stream is given up.
    const begun = performance.now();
    tvgPlayer.load();
    await new Promise((resolve) => tvgPlayer.addEventListener("canplay", resolve, { once: true }));
    return performance.now() - begun;
  });
  console.log(`first frame, the player being there: ${first.toFixed(0)} ms`);

  const stalls = await page.evaluate(async () => {
    let count = 0;
    tvgPlayer.addEventListener("waiting", () => ++count);
    tvgPlayer.loop = false;
    tvgPlayer.play();
    const until = performance.now() + 1000 * Math.min(60, tvgPlayer.duration - 1);
    while (performance.now() < until) await new Promise((resolve) => setTimeout(resolve, 100));
    return [count, tvgPlayer.currentTime];
  });
  console.log(`${stalls[0]} stalls in ${stalls[1].toFixed(1)} s of playing`);
  await page.close();

  // Anew, so that nothing is kept: each seek goes where no byte has been fetched, or near it by chance.
  const again = await open();
  const seeks = await again.page.evaluate(async (count) => {
    const times = [];
    tvgPlayer.pause();
    for (let i = 0; i < count; ++i) {
      const begun = performance.now();
      const done = new Promise((resolve) => tvgPlayer.addEventListener("seeked", resolve, { once: true }));
      tvgPlayer.currentTime = ((i * 0.618034 + 0.3) % 1) * tvgPlayer.duration;
      await done;
      times.push(performance.now() - begun);
    }
    return times.sort((a, b) => a - b);
  }, kSeeks);
  const median = seeks[kSeeks / 2];
  console.log(`seeks: median ${median.toFixed(0)} ms, slowest ${seeks[kSeeks - 1].toFixed(0)} ms`);
} finally {
  await browser.close();
  await server.close();
}
