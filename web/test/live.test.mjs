import assert from "node:assert/strict";
import { createServer } from "node:http";
import { test } from "node:test";
import { liveAnswer } from "./page_server.mjs";
import { streamBytes, tvg } from "./toolbox.mjs";

const { TvgPlayer } = tvg;
const bytes = streamBytes("gops");
const wait = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

async function watch(options, use, playerOptions = {}) {
  const server = createServer((_, response) => liveAnswer(bytes, options)(response));
  await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
  const player = new TvgPlayer(`http://127.0.0.1:${server.address().port}/live/a`, { live: true, ...playerOptions });
  const clock = setInterval(() => player.update(0.02), 20);
  try {
    await use(player);
  } finally {
    clearInterval(clock);
    player.dispose();
    server.closeAllConnections();
    server.close();
  }
}
async function until(is) {
  for (let i = 0; i < 400 && !is(); ++i) await wait(10);
  assert.ok(is());
}

test("a live stream plays as it comes, and ends when its sender does", () =>
  watch({ seconds: 0.06, groups: 4 }, async (player) => {
    player.play();
    assert.equal(player.duration, Infinity);
    await until(() => player.frame?.number >= 4);
    assert.ok(player.behind < 1);
    await until(() => player.ended);
    assert.equal(player.frame.number, 6);
  }));

test("who falls behind goes to the newest group of frames", () =>
  watch(
    { seconds: 0.01 },
    async (player) => {
      let seeks = 0;
      player.addEventListener("seeked", () => ++seeks);
      player.play();
      await until(() => seeks > 1);
      assert.ok(player.behind < 1);
    },
    { mostBehind: 0.5 },
  ));

test("who pauses stays where they are until they ask for what is live", () =>
  watch({ seconds: 0.02 }, async (player) => {
    await until(() => player.behind > 1);
    const { number } = player.frame;
    await wait(200);
    assert.equal(player.frame.number, number);
    player.goLive();
    await until(() => !player.seeking);
    assert.ok(player.behind < 0.5 && player.frame.number > number + 20);
  }));

test("frames of a live stream that nobody shows are not kept for ever", () =>
  watch({ seconds: 0.001 }, async (player) => {
    await until(() => player.behind > 12);
    let behind;
    player.addEventListener("seeked", () => (behind = player.behind));
    player.currentTime = 0;
    await until(() => behind !== undefined);
    assert.ok(behind <= 10.5, `${behind} s are kept`);
  }));

test("a live stream that breaks off is an error, and can be joined again", () =>
  watch({ seconds: 0.02, groups: 3, cut: true }, async (player) => {
    player.play();
    await until(() => player.error !== undefined);
    assert.equal(player.error.code, "io");
    player.load();
    await until(() => player.error === undefined && player.frame !== undefined);
  }));
