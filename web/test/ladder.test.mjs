import assert from "node:assert/strict";
import { test } from "node:test";
import { longStream } from "./long_stream.mjs";
import { servePage } from "./page_server.mjs";
import { streamBytes, tvg } from "./toolbox.mjs";

const { LadderStream, parseLadder, pickStream, TvgModule, TvgPlayer } = tvg;
const module = await TvgModule.load();
const laps = 40;
const frameCount = 7 * laps;
const padded = (padding) => longStream(streamBytes("gops"), { repeats: laps, padding, frames: [2, 2, 2, 1] });
const files = { "high.tvg": padded(40000), "middle.tvg": padded(10000), "low.tvg": padded(0) };
const manifest = {
  tvg_ladder: 1,
  frame_rate: 30,
  frame_count: frameCount,
  period_frames: 7,
  streams: Object.entries(files).map(([file, { length }]) => ({
    file,
    bytes: length,
    bits_per_second: (8 * length) / (frameCount / 30),
    vertices: 21,
    bits: [6],
  })),
};
files["ladder.json"] = Buffer.from(JSON.stringify(manifest));
const rates = manifest.streams.map((rung) => rung.bits_per_second);

/** Plays in real time on a line of so many bytes per second; what was shown, of which stream, and how often it stood. */
async function play(bytesPerSecond, until, change) {
  const server = await servePage("/nonexistent", files);
  Object.assign(server, { bytesPerSecond });
  const player = new TvgPlayer(`${server.url}ladder.json`);
  const shown = [];
  const streams = [];
  let waits = 0;
  player.addEventListener("frame", () => shown.push(player.frame.number));
  player.addEventListener("waiting", () => ++waits);
  player.addEventListener("progress", () => streams.push(player.progress.stream));
  player.addEventListener("error", () => assert.fail(player.error));
  player.play();
  const begun = performance.now();
  for (let now = begun, last = begun; now - begun < 15000 && !until(player, streams); last = now) {
    if (streams.includes(0)) change?.(server);
    now = performance.now();
    player.update((now - last) / 1000);
    await new Promise((done) => setTimeout(done, 10));
  }
  assert.ok(until(player, streams), `${player.frame?.number} ${streams}`);
  player.dispose();
  await server.close();
  return { shown, streams, waits };
}

test("a stream is picked by what the line carries, with room to spare", () => {
  const pick = (megabits, bufferedSeconds, current) =>
    pickStream([8e6, 4e6, 1e6], { bytesPerSecond: megabits && (megabits * 1e6) / 8, bufferedSeconds, current });
  assert.equal(pick(undefined, 0, 2), 2, "of a line that is not known nothing is to be expected");
  assert.equal(pick(undefined, 9, 2), 1, "but what is there already carries a try");
  assert.equal(pick(100, 5, 2), 0);
  assert.equal(pick(10, 2, 2), 1, "8 of 10 Mbit/s is too near");
  assert.equal(pick(100, 0.2, 2), 2, "first there is to be something to play");
  assert.equal(pick(9, 1, 0), 0, "what plays well goes on");
  assert.equal(pick(7, 2, 0), 1);
  assert.equal(pick(7, 30, 0), 0, "what is there can be played meanwhile");
  assert.equal(pick(0.1, 0, 1), 2, "there is nothing less than the least");
});

test("what is no manifest is refused", () => {
  for (const bad of [null, 5, {}, { ...manifest, tvg_ladder: 2 }, { ...manifest, streams: [] }, { ...manifest, streams: [null] }, { ...manifest, frame_count: 0 }])
    assert.throws(() => parseLadder(bad), { code: "malformed" });
  assert.equal(parseLadder(manifest), manifest);
});

test("frames follow each other whatever stream they come from", async () => {
  const server = await servePage("/nonexistent", files);
  const stream = await LadderStream.open(`${server.url}ladder.json`, { module });
  const seen = [];
  const used = new Set();
  const meshes = [];
  for (let event; (event = await stream.next()) !== "end"; ) {
    if (event === "mesh") meshes.push(stream.decoder.view().vertexCount);
    if (event !== "frame") continue;
    seen.push(stream.frameNumber);
    used.add(stream.current);
    await new Promise((done) => setTimeout(done, 3));
    if (seen.length === 1) await stream.readIndex();
  }
  assert.deepEqual(seen, Array.from({ length: frameCount }, (_, i) => i));
  assert.ok(used.has(2) && used.has(0), [...used].join());
  assert.ok(meshes.length >= 2);
  stream.seek(100);
  while ((await stream.next()) !== "frame");
  assert.equal(stream.frameNumber, 100);
  stream.dispose();
  await server.close();
});

test("on a fast line the best stream plays soon", async () => {
  const { shown, streams } = await play((4 * rates[0]) / 8, (player) => player.ended);
  assert.equal(streams[0], 2);
  assert.equal(streams[streams.length - 1], 0);
  assert.equal(shown[shown.length - 1], frameCount - 1);
  shown.forEach((frame, i) => assert.ok(i === 0 || frame > shown[i - 1], "time jumps"));
});

test("a line that becomes slow gets a lesser stream", async () => {
  const { streams } = await play(
    (2 * rates[0]) / 8,
    (player, seen) => seen.includes(0) && [1, 2].includes(seen[seen.length - 1]),
    (server) => (server.bytesPerSecond = (0.15 * rates[0]) / 8),
  );
  assert.ok(streams.includes(0));
});
