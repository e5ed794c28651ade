import assert from "node:assert/strict";
import { test } from "node:test";
import { digests, streamBytes, tvg } from "./toolbox.mjs";

const { Decoder, TvgModule, TvgPlayer, TvgStream } = tvg;
const module = await TvgModule.load();
const round = Math.fround;

/** Sums in float32 as a GPU makes them, and what docs/web.md says that they are off by at most: [vertex][xyz]. */
function sums(vertexCount, components, coefficient, rows) {
  const values = new Float32Array(3 * vertexCount);
  const bounds = new Float64Array(3 * vertexCount);
  for (let i = 0; i < values.length; ++i) {
    let sum = rows[i % 3];
    let size = Math.abs(sum);
    for (let a = 0; a < components; ++a) {
      const term = round(coefficient(a, Math.floor(i / 3)) * rows[3 * (a + 1) + (i % 3)]);
      sum = round(sum + term);
      size += Math.abs(term);
    }
    values[i] = sum;
    bounds[i] = (components + 4) * size * 2 ** -23;
  }
  return { values, bounds };
}
function assertNear({ values, bounds }, positions, name) {
  values.forEach((value, i) => assert.ok(Math.abs(value - positions[i]) <= bounds[i], `${name}: ${value} for ${positions[i]}`));
}

const names = digests().map(({ name }) => name);
const basisNames = names.filter((name) => /basis/.test(name));

test("the sums of a frame's planes are its positions, in every stream of mode basis", async () => {
  let frames = 0;
  for (const name of basisNames) {
    const stream = await TvgStream.open(streamBytes(name), { module });
    const { decoder } = stream;
    for (let event; (event = await stream.next()) !== "end"; ) {
      const basis = event === "frame" && decoder.basis();
      if (!basis) continue;
      ++frames;
      const { components, vertexCount } = basis;
      const groups = Array.from({ length: Math.ceil(components / 4) }, (_, group) => {
        const floats = new Float32Array(4 * vertexCount);
        const shorts = new Int16Array(4 * vertexCount);
        decoder.copyPlanes(group, floats);
        if (basis.most < 32768) {
          decoder.copyPlanes(group, shorts);
          assert.deepEqual([...shorts], [...floats]);
        }
        return floats;
      });
      const rows = new Float32Array(3 * (1 + components));
      decoder.copyRows(rows);
      const positions = new Float32Array(3 * vertexCount);
      decoder.copyPositions(positions);
      assertNear(sums(vertexCount, components, (a, v) => groups[a >> 2][4 * v + (a & 3)], rows), positions, name);
    }
    stream.dispose();
  }
  assert.ok(basisNames.length >= 5 && frames > 40);
});

test("other modes have no planes", async () => {
  const stream = await TvgStream.open(streamBytes("elp"), { module });
  while ((await stream.next()) !== "frame");
  assert.equal(stream.decoder.basis(), undefined);
  assert.throws(() => stream.decoder.copyPlanes(0, new Float32Array(8)), { code: "wrong-state" });
  assert.throws(() => stream.decoder.copyRows(new Float32Array(6)), { code: "wrong-state" });
  stream.dispose();
  assert.throws(() => new Decoder(module).basis(), { code: "wrong-state" });
});

/** All frames that a player gives, by their number. */
async function play(name, options) {
  const player = new TvgPlayer(streamBytes(name), options);
  const frames = new Map();
  player.addEventListener("frame", () => frames.set(player.frame.number, player.frame));
  player.addEventListener("canplay", () => player.play());
  for (let steps = 0; !player.ended; ++steps) {
    assert.ok(steps < 2000 && !player.error, player.error?.message);
    player.update(0.5 / player.frameRate);
    await new Promise((resolve) => setTimeout(resolve, 2));
  }
  player.dispose();
  return { frames, mesh: player.mesh };
}

for (const name of basisNames) {
  test(`a player gives planes once for a period and rows for each frame: ${name}`, async () => {
    const { frames } = await play(name, {});
    const { frames: made, mesh } = await play(name, { gpu: true });
    assert.deepEqual([...made.keys()], [...frames.keys()]);
    const periods = new Set();
    for (const [number, { positions, rows, planes, normals }] of made) {
      if (!rows) {
        assert.equal(name, "basis_and_elp");
        assert.deepEqual(positions, frames.get(number).positions);
        continue;
      }
      assert.ok(positions.length === 0 && normals === undefined);
      periods.add(planes);
      const { components, vertexCount, width, height, coefficients } = planes;
      const coefficient = (a, v) => coefficients[4 * ((a >> 2) * width * height + v) + (a & 3)];
      const { values, bounds } = sums(vertexCount, components, coefficient, rows);
      const of = (array) => Array.from(mesh.sourceVertices, (v) => [...array.subarray(3 * v, 3 * v + 3)]).flat();
      assertNear({ values: of(values), bounds: of(bounds) }, frames.get(number).positions, name);
    }
    assert.ok(periods.size >= 1 && periods.size < made.size / 2);
  });
}

test("planes beyond what the GPU can take come as positions", async () => {
  for (const limits of [{ textureSize: 4 }, { layers: 0 }, { components: 1 }]) {
    const { frames } = await play("basis", { gpu: { textureSize: 2048, layers: 256, components: 256, ...limits } });
    for (const { rows, positions } of frames.values()) assert.ok(rows === undefined && positions.length > 0);
  }
});
