import assert from "node:assert/strict";
import { test } from "node:test";
import { digests, positionsDigest, streamBytes, tvg } from "./toolbox.mjs";

const { Decoder, TvgError, TvgModule, TvgStream } = tvg;
const module = await TvgModule.load();

test("frames of every conformance stream are the native decoder's, bit for bit", async () => {
  const rows = digests();
  assert.ok(rows.length > 30);
  for (const { name, frames, positions } of rows) {
    const stream = await TvgStream.open(streamBytes(name), { module });
    assert.deepEqual(await positionsDigest(stream), { frames, positions }, name);
    stream.dispose();
  }
});

test("bytes may come one at a time", () => {
  const decoder = new Decoder(module);
  const bytes = streamBytes("gops");
  let at = 0;
  let frames = 0;
  for (let event; (event = decoder.poll()) !== "end"; ) {
    assert.notEqual(event, "error");
    if (event === "frame") ++frames;
    if (event === "need-bytes") at < bytes.length ? decoder.push(bytes.subarray(at, ++at)) : decoder.finish();
  }
  assert.equal(frames, 7);
  decoder.dispose();
});

test("limits refuse a stream before it is decoded", async () => {
  await assert.rejects(TvgStream.open(streamBytes("elp"), { module, limits: { vertices: 10 } }), {
    name: "TvgError",
    code: "limit-exceeded",
  });
});

test("what is no stream is told by its code", async () => {
  await assert.rejects(TvgStream.open(new Uint8Array(100).fill(65), { module }), { code: "not-tvg" });
});

test("attributes come for the mesh and for the view that hardware draws", async () => {
  const stream = await TvgStream.open(streamBytes("attributes"), { module });
  assert.equal(await stream.next(), "mesh");
  assert.equal(await stream.next(), "frame");
  const { decoder } = stream;
  const view = decoder.view();
  const mesh = decoder.mesh();
  assert.equal(view.indices.length, 3 * mesh.faceCount);
  assert.equal(view.ranges.reduce((sum, range) => sum + range.indexCount, 0), view.indices.length);
  const attributes = decoder.attributes();
  assert.ok(attributes.length > 0);
  for (const attribute of attributes) {
    const values = new Float32Array(attribute.components * attribute.valueCount);
    decoder.copyAttribute(attribute, values);
    assert.ok(values.every(Number.isFinite));
    const shown = new Float32Array(attribute.components * view.vertexCount);
    decoder.copyViewAttribute(attribute, shown);
    assert.ok(shown.some((value) => value !== 0));
  }
  const positions = new Float32Array(3 * view.vertexCount);
  const own = new Float32Array(3 * mesh.vertexCount);
  decoder.copyViewPositions(positions);
  decoder.copyPositions(own);
  view.sourceVertices.forEach((vertex, v) => assert.equal(positions[3 * v], own[3 * vertex]));
  stream.dispose();
});

test("arrays that are too small are refused", async () => {
  const stream = await TvgStream.open(streamBytes("elp"), { module });
  while ((await stream.next()) !== "frame");
  assert.throws(() => stream.decoder.copyPositions(new Float32Array(3)), { code: "invalid-argument" });
  stream.dispose();
  assert.throws(() => stream.decoder.poll(), (error) => error instanceof TvgError && error.code === "wrong-state");
});

test("decoders that were disposed of leave nothing behind", async () => {
  const play = async () => {
    const stream = await TvgStream.open(streamBytes("attributes_soup"), { module });
    await positionsDigest(stream);
    stream.dispose();
  };
  for (let i = 0; i < 20; ++i) await play();
  const before = module.memoryBytes;
  for (let i = 0; i < 300; ++i) await play();
  assert.equal(module.memoryBytes, before);
});
