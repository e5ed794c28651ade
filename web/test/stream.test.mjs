import assert from "node:assert/strict";
import { test } from "node:test";
import { digests, positionsDigest, serve, streamBytes, tvg } from "./toolbox.mjs";

const { TvgModule, TvgStream } = tvg;
const module = await TvgModule.load();
const expected = (name) => {
  const { frames, positions } = digests().find((row) => row.name === name);
  return { frames, positions };
};

async function withServer(name, options, use) {
  const server = await serve(streamBytes(name), options);
  try {
    await use(server);
  } finally {
    await server.close();
  }
}

async function nextFrame(stream) {
  for (let event; (event = await stream.next()) !== "end"; ) if (event === "frame") return stream.frameNumber;
  return undefined;
}

for (const ranges of [true, false]) {
  const kind = ranges ? "with ranges" : "without ranges";
  test(`a server ${kind} gives all frames`, () =>
    withServer("elp", { ranges }, async ({ url }) => {
      const stream = await TvgStream.open(url, { module });
      if (ranges) assert.equal(stream.frameCount, 6);
      assert.deepEqual(await positionsDigest(stream), expected("elp"));
      stream.dispose();
    }));

  test(`any frame can be sought on a server ${kind}`, () =>
    withServer("gops", { ranges }, async ({ url }) => {
      const stream = await TvgStream.open(url, { module });
      for (const frame of [5, 0, 6, 3, 1]) {
        stream.seek(frame);
        assert.equal(await nextFrame(stream), frame);
      }
      stream.seek(0);
      assert.deepEqual(await positionsDigest(stream), expected("gops"));
      stream.dispose();
    }));
}

test("a connection that is cut is taken up again", () =>
  withServer("lossless", { cutAfter: 900, cuts: 3 }, async ({ url, requests }) => {
    const stream = await TvgStream.open(url, { module, index: false });
    assert.deepEqual(await positionsDigest(stream), expected("lossless"));
    assert.ok(requests.length >= 4, requests.join());
    stream.dispose();
  }));

test("damage is told, and the frames after it come", async () => {
  const bytes = streamBytes("gops");
  bytes[Math.floor(bytes.length / 2)] ^= 1;
  const damage = [];
  const stream = await TvgStream.open(bytes, { module, onDamage: (found) => damage.push(found) });
  const { frames } = await positionsDigest(stream);
  assert.ok(damage.length > 0 && damage[0].code === "checksum-mismatch", JSON.stringify(damage));
  assert.ok(frames > 0 && frames < 7);
  stream.dispose();
});

test("an aborted signal ends a stream with its reason", () =>
  withServer("elp", {}, async ({ url }) => {
    const control = new AbortController();
    const stream = await TvgStream.open(url, { module, signal: control.signal, index: false });
    control.abort(new Error("enough"));
    await assert.rejects(TvgStream.open(url, { module, signal: control.signal }), { message: "enough" });
    stream.dispose();
  }));

test("what a server refuses is an error of io", () =>
  withServer("elp", {}, async (server) => {
    await server.close();
    await assert.rejects(TvgStream.open(server.url, { module }), { name: "TvgError", code: "io" });
  }));
