// TVGLoader and TVGMesh in Node, without a renderer; skipped where three.js is not there.
import assert from "node:assert/strict";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { longStream } from "./long_stream.mjs";
import { packageFolder, serve, streamBytes } from "./toolbox.mjs";

const three = join(dirname(fileURLToPath(import.meta.url)), "../node_modules/three");
const isThere = existsSync(three) && existsSync(join(packageFolder, "dist/three/index.js"));
const skip = isThere ? false : "there is no three.js in web/node_modules (npm ci), or the package was built without";

const folder = mkdtempSync(join(tmpdir(), "tvg-three-"));
after(() => rmSync(folder, { recursive: true, force: true }));
let THREE, TVGLoader;
if (isThere) {
  const home = join(folder, "node_modules/tvg");
  mkdirSync(home, { recursive: true });
  cpSync(packageFolder, home, { recursive: true, filter: (path) => !path.endsWith("/page") });
  symlinkSync(three, join(folder, "node_modules/three"));
  globalThis.ProgressEvent ??= class extends Event {
    constructor(type, values) {
      super(type);
      Object.assign(this, values);
    }
  };
  THREE = await import(pathToFileURL(join(three, "build/three.module.js")).href);
  ({ TVGLoader } = await import(pathToFileURL(join(home, "dist/three/index.js")).href));
}

const newLoader = () => new TVGLoader().setDecoder(readFileSync(join(packageFolder, "dist/tvg.wasm"))).setWorkerLimit(0);
const parse = (bytes) => new Promise((resolve, reject) => newLoader().parse(bytes.buffer.slice(0), resolve, reject));

test("load and loadAsync give a mesh with its first frame, and tell the manager", { skip }, async () => {
  const server = await serve(streamBytes("gops"));
  const loader = newLoader().preload();
  const mesh = await loader.loadAsync(server.url);
  assert.equal(mesh.geometry.getAttribute("position").count, mesh.player.mesh.vertexCount);
  assert.equal(mesh.geometry.index.count, mesh.player.mesh.indices.length);
  assert.ok(mesh.geometry.getAttribute("normal"));
  mesh.currentTime = 5 / mesh.player.frameRate;
  await new Promise((done) => mesh.addEventListener("seeked", done));
  assert.equal(mesh.player.frame.number, 5);
  mesh.dispose();
  await new Promise((done) => loader.load(server.url, done, undefined, assert.fail));
  loader.dispose();
  await server.close();
});

test("parse tells what is no stream, and dispose may come twice", { skip }, async () => {
  await assert.rejects(parse(new Uint8Array(64)), { code: "not-tvg" });
  const mesh = await parse(streamBytes("elp"));
  mesh.dispose();
  mesh.dispose();
});

test("a worker that cannot start is an error, and the next load tries another", { skip }, async () => {
  let made = 0;
  const newWorker = () => {
    ++made;
    const worker = { postMessage() {}, terminate() {} };
    setTimeout(() => worker.onerror({ message: "no such script" }), 10);
    return worker;
  };
  const loader = newLoader().setWorkerLimit(1).setWorker(newWorker);
  for (let i = 0; i < 2; ++i) await assert.rejects(loader.loadAsync("http://127.0.0.1:9/a.tvg"), { code: "io", message: /no such script/ });
  assert.equal(made, 2);
});

test("attributes that change do so with the frame", { skip }, async () => {
  const mesh = await parse(streamBytes("animated"));
  const animated = mesh.player.mesh.attributes.filter((attribute) => attribute.animated);
  assert.ok(animated.length > 0);
  const snapshot = () => Object.entries(mesh.geometry.attributes).map(([name, { array }]) => [name, array.slice()]);
  const first = new Map(snapshot());
  mesh.currentTime = 2 / mesh.player.frameRate;
  await new Promise((done) => mesh.addEventListener("seeked", done));
  const changed = snapshot().filter(([name, array]) => array.some((value, i) => value !== first.get(name)[i]));
  assert.ok(changed.length > 1, changed.map(([name]) => name).join());
  mesh.dispose();
});

test("important vertices are coloured while that is asked for", { skip }, async () => {
  const mesh = await parse(streamBytes("hybrid"));
  const [own] = mesh.material;
  mesh.importance = true;
  await new Promise((done) => mesh.addEventListener("seeked", done));
  const { array } = mesh.geometry.getAttribute("color");
  const { flags } = mesh.player;
  assert.equal(array.length, 3 * flags.length);
  const isOrange = (v) => array[3 * v] > 3 * array[3 * v + 2];
  flags.forEach((flag, v) => assert.equal(isOrange(v), flag === 1));
  assert.notEqual(mesh.material[0], own);
  mesh.importance = false;
  assert.equal(mesh.material[0], own);
  assert.equal(mesh.geometry.getAttribute("color"), undefined);
  mesh.dispose();
});

const materials = {
  materials: [
    {
      name: "",
      pbrMetallicRoughness: { baseColorFactor: [0.5, 0.25, 1, 0.5], metallicFactor: 0.25, roughnessFactor: 0.75, baseColorTexture: { index: 0 } },
      emissiveFactor: [0, 1, 0],
      alphaMode: "BLEND",
      doubleSided: false,
    },
  ],
  textures: [{ source: 0, sampler: 0 }, { source: 7 }],
  images: [{ extras: { data: "image/a.png" } }],
  samplers: [{ wrapS: 33071, magFilter: 9728 }],
};

function withData(data) {
  return longStream(streamBytes("gops"), { repeats: 1, frames: [2, 2, 2, 1], data });
}

test("materials and pictures of a stream become three's, and are given back", { skip }, async () => {
  const closed = [];
  const asked = [];
  globalThis.createImageBitmap = async (blob, options) => {
    asked.push([blob.size, options.imageOrientation]);
    return { width: 1, height: 1, close: () => closed.push(1) };
  };
  try {
    const json = new TextEncoder().encode(JSON.stringify(materials));
    const mesh = await parse(withData({ materials: json, "image/a.png": new Uint8Array(5) }));
    const [material] = mesh.material;
    assert.deepEqual(material.color.toArray(), [0.5, 0.25, 1]);
    assert.deepEqual([material.metalness, material.roughness, material.opacity], [0.25, 0.75, 0.5]);
    assert.deepEqual(material.emissive.toArray(), [0, 1, 0]);
    assert.ok(material.transparent && material.side === THREE.FrontSide);
    assert.deepEqual(asked, [[5, "flipY"]]);
    assert.equal(material.map.wrapS, THREE.ClampToEdgeWrapping);
    assert.equal(material.map.colorSpace, THREE.SRGBColorSpace);
    mesh.dispose();
    await new Promise((done) => setTimeout(done));
    assert.equal(closed.length, 1);
  } finally {
    delete globalThis.createImageBitmap;
  }
});

test("materials that are broken leave the mesh plain", { skip }, async (context) => {
  context.mock.method(console, "warn", () => undefined);
  const broken = ["{", "[]", "5", "null", '{"materials": 1}', '{"materials": [null, {"name": "", "pbrMetallicRoughness": {"baseColorFactor": "x", "baseColorTexture": {"index": 5}}}]}'];
  for (const text of broken) {
    const mesh = await parse(withData({ materials: new TextEncoder().encode(text) }));
    assert.equal(mesh.material.length, 1, text);
    mesh.dispose();
  }
});
