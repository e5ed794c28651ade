import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { longStream } from "./long_stream.mjs";
import { packageFolder, serve, streamBytes, tvg } from "./toolbox.mjs";

const load = (name) => import(pathToFileURL(join(packageFolder, "dist", `${name}.js`)).href);
const { ByteCache } = await load("byte_cache");
const { Throughput } = await load("throughput");
const { FrameTimeRanges } = await load("time_ranges");
const { TvgModule, TvgPlayer, TvgStream } = tvg;
const module = await TvgModule.load();
const frames = [2, 2, 2, 1];
const long = longStream(streamBytes("gops"), { repeats: 20, padding: 20000, frames });
const wait = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

async function readAll(stream) {
  let count = 0;
  for (let event; (event = await stream.next()) !== "end"; ) if (event === "frame") ++count;
  return count;
}

test("a cache gives back what it was given, whatever comes in what order", () => {
  const whole = Uint8Array.from({ length: 1000 }, (_, i) => i % 251);
  let seed = 1;
  const random = (below) => (seed = (seed * 48271) % 2147483647) % below;
  for (let round = 0; round < 50; ++round) {
    const cache = new ByteCache(1e6);
    const known = new Set();
    for (let i = 0; i < 30; ++i) {
      const from = random(900);
      const to = from + random(100);
      cache.add(from, whole.subarray(from, to), 0);
      for (let at = from; at < to; ++at) known.add(at);
    }
    for (let at = 0; at < 1000; ++at) {
      assert.equal(cache.at(at)?.[0], known.has(at) ? whole[at] : undefined);
      let gap = at;
      while (known.has(gap)) ++gap;
      assert.equal(cache.firstGap(at), gap);
    }
    assert.equal(cache.ranges().reduce((sum, [from, to]) => sum + to - from, 0), known.size);
  }
});

test("a cache that is full drops what is farthest from its reader", () => {
  const cache = new ByteCache(300);
  for (const at of [0, 100, 200, 300]) cache.add(at, new Uint8Array(100), 300);
  assert.deepEqual(cache.ranges(), [[100, 400]]);
  cache.add(0, new Uint8Array(100), 0);
  assert.deepEqual(cache.ranges(), [[0, 300]]);
});

test("the line's speed is that of bytes that were waited for", () => {
  const line = new Throughput();
  assert.equal(line.bytesPerSecond, undefined);
  for (let i = 0; i < 40; ++i) line.add(100000, 0.1);
  assert.ok(Math.abs(line.bytesPerSecond - 1e6) < 1000);
  line.pause();
  for (let i = 0; i < 8; ++i) line.add(100000, 0);
  assert.ok(Math.abs(line.bytesPerSecond - 1e6) < 1000, "what was buffered counts");
  for (let i = 0; i < 100; ++i) line.add(10000, 0.1);
  assert.ok(line.bytesPerSecond < 2e5, "what was long ago counts");
});

test("ranges of time are HTMLMediaElement's", () => {
  const ranges = new FrameTimeRanges([[30, 60], [0, 15], [15, 20], [60, 61]], 10);
  assert.equal(ranges.length, 2);
  assert.deepEqual([ranges.start(0), ranges.end(0), ranges.start(1), ranges.end(1)], [0, 2, 3, 6.1]);
  assert.throws(() => ranges.end(2), RangeError);
});

test("what was fetched is not fetched again", async () => {
  const server = await serve(long);
  const stream = await TvgStream.open(server.url, { module });
  assert.equal(stream.frameCount, 140);
  assert.equal(await readAll(stream), 140);
  const requests = server.requests.length;
  for (let lap = 0; lap < 3; ++lap) {
    stream.seek(0);
    assert.equal(await readAll(stream), 140);
  }
  assert.equal(server.requests.length, requests, server.requests.join());
  assert.deepEqual(stream.progress().frames, [[0, 140]]);
  stream.dispose();
  await server.close();
});

test("no more is fetched ahead than was asked for", async () => {
  const server = await serve(long);
  const stream = await TvgStream.open(server.url, { module, aheadBytes: 200000 });
  while ((await stream.next()) !== "frame");
  await wait(200);
  const { received, frames: there, firstFrames } = stream.progress();
  assert.ok(received >= 200000 && received < 600000, `${received} bytes`);
  assert.equal(firstFrames, 1);
  assert.equal(there[0][0], 0);
  assert.ok(there[0][1] > 10 && there[0][1] < 60, `${there[0][1]} frames`);
  assert.equal(await readAll(stream), 139);
  stream.dispose();
  await server.close();
});

test("a player tells what is there, and asks for flags when it is told to", async () => {
  const server = await serve(longStream(streamBytes("hybrid"), { repeats: 3, frames: [6] }));
  const player = new TvgPlayer(server.url);
  const once = (name) => new Promise((done) => player.addEventListener(name, done, { once: true }));
  await once("canplay");
  assert.equal(player.flags, undefined);
  player.wantsFlags = true;
  await once("seeked");
  assert.equal(player.flags.length, player.mesh.vertexCount);
  assert.ok(player.flags.includes(1) && player.flags.includes(0));
  while (player.buffered.length === 0 || player.buffered.end(0) < player.duration) await wait(50);
  assert.equal(player.buffered.start(0), 0);
  player.dispose();
  await server.close();
});

test("a worker that does not start is an error, before and after a stream is opened", async () => {
  const { WorkerHost } = tvg;
  for (const isLate of [true, false]) {
    const worker = { postMessage() {}, terminate() {} };
    const host = new WorkerHost(worker);
    if (!isLate) worker.onerror({ message: "" });
    const player = new TvgPlayer(long, { host });
    const failed = new Promise((done) => player.addEventListener("error", done));
    if (isLate) setTimeout(() => worker.onerror({ message: "" }), 100);
    await failed;
    assert.equal(player.error.code, "io");
    assert.match(player.error.message, /worker/);
    assert.ok(host.isBroken);
    player.dispose();
  }
});
