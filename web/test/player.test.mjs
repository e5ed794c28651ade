import assert from "node:assert/strict";
import { test } from "node:test";
import { streamBytes, tvg } from "./toolbox.mjs";

const { TvgPlayer } = tvg;
const once = (player, name) => new Promise((resolve) => player.addEventListener(name, resolve, { once: true }));
const pause = () => new Promise((resolve) => setTimeout(resolve, 2));

/** Plays in steps of half a frame until `done`, and returns the numbers of the frames shown. */
async function play(player, done) {
  const shown = [];
  player.addEventListener("frame", () => shown.push(player.frame.number));
  for (let steps = 0; !done() && steps < 2000; ++steps) {
    player.update(0.5 / player.frameRate);
    await pause();
  }
  assert.ok(done(), `it stands at ${player.currentTime}`);
  return shown;
}

test("a stream plays to its end once", async () => {
  const player = new TvgPlayer(streamBytes("gops"), { ahead: 3 });
  let ended = 0;
  player.addEventListener("ended", () => ++ended);
  await once(player, "canplay");
  assert.equal(player.duration, 7 / player.frameRate);
  player.play();
  assert.deepEqual(await play(player, () => player.ended), [1, 2, 3, 4, 5, 6]);
  assert.equal(ended, 1);
  assert.ok(player.paused);
  player.dispose();
});

test("a loop goes on with the first frame, without an end", async () => {
  const player = new TvgPlayer(streamBytes("gops"), { ahead: 3 });
  let ended = 0;
  player.addEventListener("ended", () => ++ended);
  player.loop = true;
  await once(player, "canplay");
  player.play();
  let laps = 0;
  player.addEventListener("frame", () => (laps = player.frame.lap));
  const shown = await play(player, () => laps === 3);
  assert.deepEqual(shown.slice(0, 14), [1, 2, 3, 4, 5, 6, 0, 1, 2, 3, 4, 5, 6, 0]);
  assert.equal(ended, 0);
  player.dispose();
});

test("a seek shows the frame sought, while paused too", async () => {
  const player = new TvgPlayer(streamBytes("gops"), { ahead: 3 });
  await once(player, "canplay");
  for (const frame of [5, 0, 6, 2]) {
    const sought = once(player, "seeked");
    player.currentTime = frame / player.frameRate;
    assert.ok(player.seeking);
    await sought;
    assert.equal(player.frame.number, frame);
  }
  player.dispose();
});

test("damage is told and passed over", async () => {
  const bytes = streamBytes("gops");
  bytes[Math.floor(bytes.length / 2)] ^= 1;
  const player = new TvgPlayer(bytes, { ahead: 3 });
  let damage = 0;
  player.addEventListener("damage", () => ++damage);
  await once(player, "canplay");
  player.play();
  await play(player, () => player.ended);
  assert.equal(damage, 1);
  player.dispose();
});

test("what cannot be played is an error, and the clock stands", async () => {
  const player = new TvgPlayer(new Uint8Array(64), {});
  await once(player, "error");
  assert.equal(player.error.code, "not-tvg");
  player.update(1);
  assert.equal(player.currentTime, 0);
});
