// What gpu.test.mjs runs in a page.
import * as THREE from "three";
import { LocalHost, TvgPlayer, TvgStream } from "tvg";
import { TVGMesh } from "tvg/three";

const kSize = 256;

/** Frames of a stream as the CPU makes them, by their number, and how far a GPU's may be off. */
async function framesOf(url) {
  const stream = await TvgStream.open(url);
  const { decoder } = stream;
  const frames = new Map();
  for (let event; (event = await stream.next()) !== "end"; ) {
    if (event !== "frame") continue;
    const positions = new Float32Array(3 * decoder.mesh().vertexCount);
    decoder.copyPositions(positions);
    frames.set(stream.frameNumber, { positions, bounds: boundsOf(decoder) });
  }
  stream.dispose();
  return frames;
}

/** [vertex][xyz]; undefined in other modes. */
function boundsOf(decoder) {
  const basis = decoder.basis();
  if (!basis) return undefined;
  const rows = new Float32Array(3 * (1 + basis.components));
  decoder.copyRows(rows);
  const sizes = Float64Array.from({ length: 3 * basis.vertexCount }, (_, i) => Math.abs(rows[i % 3]));
  const group = new Float32Array(4 * basis.vertexCount);
  for (let a = 0; a < basis.components; ++a) {
    if (a % 4 === 0) decoder.copyPlanes(a / 4, group);
    for (let i = 0; i < sizes.length; ++i) {
      sizes[i] += Math.abs(group[4 * Math.floor(i / 3) + (a % 4)] * rows[3 * (a + 1) + (i % 3)]);
    }
  }
  return sizes.map((size) => (basis.components + 4) * size * 2 ** -23);
}

const worstOf = (values, { positions, bounds }) =>
  values.reduce((worst, value, i) => Math.max(worst, Math.abs(value - positions[i]) / Math.max(bounds[i], 1e-30)), 0);

function newScene(mesh) {
  const renderer = new THREE.WebGLRenderer({ antialias: false, preserveDrawingBuffer: true });
  renderer.setSize(kSize, kSize);
  document.body.append(renderer.domElement);
  const scene = new THREE.Scene();
  scene.add(new THREE.HemisphereLight(0xffffff, 0x445566, 2), mesh);
  return { renderer, scene, camera: new THREE.PerspectiveCamera(40, 1, 0.001, 1000) };
}

function lookAt(camera, { center, radius }, up = 0.35) {
  camera.position.set(0.5, up, 1).setLength(3.1 * radius).add(center);
  camera.lookAt(center);
}

function pixelsOf(renderer) {
  const gl = renderer.getContext();
  const pixels = new Uint8Array(4 * kSize * kSize);
  gl.readPixels(0, 0, kSize, kSize, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return pixels.filter((_, i) => i % 4 < 3);
}
const difference = (a, b) => a.reduce((sum, value, i) => sum + Math.abs(value - b[i]), 0) / a.length;

const untilFrame = (player, number) =>
  new Promise((resolve) => {
    const look = () => (player.frame?.number === number && !player.seeking ? resolve() : setTimeout(look, 2));
    player.currentTime = number / player.frameRate;
    look();
  });
const untilReady = (player) => new Promise((resolve) => player.addEventListener("canplay", resolve, { once: true }));

/** Tells of meshes as if each vertex had two values of an attribute: render vertices of the second half of the faces are others. */
class SeamHost extends LocalHost {
  open(id, request, answer) {
    super.open(id, request, (told) => {
      if (told.type === "mesh") told.mesh = withSeam(told.mesh);
      if (told.type === "planes") twice(told.planes);
      if (told.type === "frame") twice(told.frame);
      answer(told);
    });
  }
}
function withSeam(mesh) {
  const { vertexCount, sourceVertices } = mesh;
  const half = mesh.indices.length / 6;
  const indices = mesh.indices.map((vertex, i) => vertex + (i / 3 < half ? 0 : vertexCount));
  return { ...mesh, vertexCount: 2 * vertexCount, indices, sourceVertices: Uint32Array.of(...sourceVertices, ...sourceVertices) };
}
function twice(frame) {
  for (const name of ["positions", "normals"]) if (frame[name]) frame[name] = Float32Array.of(...frame[name], ...frame[name]);
}

async function openMesh(url, useGpu, makeMaterial, host = new LocalHost()) {
  const mesh = new TVGMesh(new TvgPlayer(url, { host }), makeMaterial);
  const view = newScene(mesh);
  if (useGpu && !mesh.useGpu(view.renderer)) throw new Error("the GPU cannot");
  await untilReady(mesh.player);
  await mesh.ready;
  return { mesh, ...view };
}

/** Every frame of a stream drawn with and without the GPU. */
globalThis.compare = async (url, hasSeam = false) => {
  const expected = await framesOf(url);
  const host = () => (hasSeam ? new SeamHost() : new LocalHost());
  const own = await openMesh(url, false, undefined, host());
  const gpu = await openMesh(url, true, undefined, host());
  let made = 0;
  let worst = 0;
  let pixels = 0;
  let brightness = 0;
  for (const [number, frame] of expected) {
    await untilFrame(own.mesh.player, number);
    await untilFrame(gpu.mesh.player, number);
    if (gpu.mesh.player.frame.rows) {
      ++made;
      worst = Math.max(worst, worstOf(gpu.mesh.readGpuPositions(), frame));
    }
    const sphere = own.mesh.geometry.boundingSphere ?? (own.mesh.geometry.computeBoundingSphere(), own.mesh.geometry.boundingSphere);
    const bound = gpu.mesh.geometry.boundingSphere;
    if (bound && frame.positions.some((_, i) => i % 3 === 0 && distance(frame.positions, i, bound.center) > bound.radius * 1.00001)) {
      throw new Error("a vertex is outside of the sphere");
    }
    const pictures = [own, gpu].map(({ renderer, scene, camera }) => {
      lookAt(camera, sphere);
      renderer.render(scene, camera);
      return pixelsOf(renderer);
    });
    pixels = Math.max(pixels, difference(...pictures));
    brightness = Math.max(brightness, pictures[0].reduce((sum, value) => sum + value, 0) / pictures[0].length);
  }
  for (const { mesh, renderer } of [own, gpu]) mesh.dispose(), renderer.dispose();
  return { frames: expected.size, made, worst, pixels, brightness };
};

const distance = (positions, i, { x, y, z }) => Math.hypot(positions[i] - x, positions[i + 1] - y, positions[i + 2] - z);

globalThis.fallBack = async (url) => {
  const mesh = new TVGMesh(new TvgPlayer(url));
  const used = mesh.useGpu({ isWebGPURenderer: true });
  await untilReady(mesh.player);
  const { rows, positions } = mesh.player.frame;
  mesh.dispose();
  return { used, rows: rows !== undefined, positions: positions.length > 0 };
};

globalThis.compareShadows = async (url) => {
  const draw = async (useGpu, castsShadow) => {
    const { mesh, renderer, scene, camera } = await openMesh(url, useGpu, (name) => new THREE.MeshPhongMaterial({ name, side: THREE.DoubleSide }));
    await untilFrame(mesh.player, 9);
    renderer.shadowMap.enabled = true;
    mesh.geometry.computeBoundingSphere();
    const sphere = mesh.geometry.boundingSphere.clone();
    mesh.castShadow = castsShadow;
    const floor = new THREE.Mesh(new THREE.PlaneGeometry(20 * sphere.radius, 20 * sphere.radius), new THREE.MeshPhongMaterial());
    floor.rotation.x = -Math.PI / 2;
    floor.position.copy(sphere.center).y -= 2 * sphere.radius;
    floor.receiveShadow = true;
    const sun = new THREE.DirectionalLight(0xffffff, 2);
    sun.position.copy(sphere.center).y += 4 * sphere.radius;
    sun.target = floor;
    Object.assign(sun.shadow.camera, { left: -3 * sphere.radius, right: 3 * sphere.radius, top: 3 * sphere.radius, bottom: -3 * sphere.radius, near: sphere.radius / 10, far: 20 * sphere.radius });
    const lamp = new THREE.PointLight(0xffffff, 30 * sphere.radius ** 2);
    lamp.position.copy(sun.position).x += sphere.radius;
    lamp.shadow.camera.near = sphere.radius / 10;
    lamp.shadow.camera.far = 20 * sphere.radius;
    sun.castShadow = lamp.castShadow = true;
    scene.add(floor, sun, lamp);
    lookAt(camera, new THREE.Sphere(sphere.center, 2 * sphere.radius), 0.8);
    renderer.render(scene, camera);
    const pixels = pixelsOf(renderer);
    for (const material of mesh.material) material.wireframe = true;
    renderer.render(scene, camera);
    const wired = pixelsOf(renderer);
    mesh.dispose();
    renderer.dispose();
    return { pixels, wired };
  };
  const own = await draw(false, true);
  const gpu = await draw(true, true);
  const without = await draw(true, false);
  return {
    pixels: Math.max(difference(own.pixels, gpu.pixels), difference(own.wired, gpu.wired)),
    shadow: difference(gpu.pixels, without.pixels),
  };
};

/** Positions that the program of the example for WebGL2 makes, through transform feedback. */
export async function readBack(player, gl) {
  player.pause();
  const { rows } = player.frame;
  const frame = (await framesOf(new URLSearchParams(location.search).get("stream"))).get(player.frame.number);
  const { vertexCount } = player.mesh;
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, buffer);
  gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, 12 * vertexCount, gl.STREAM_READ);
  gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
  gl.enable(gl.RASTERIZER_DISCARD);
  gl.beginTransformFeedback(gl.POINTS);
  gl.drawArrays(gl.POINTS, 0, vertexCount);
  gl.endTransformFeedback();
  gl.disable(gl.RASTERIZER_DISCARD);
  const positions = new Float32Array(3 * vertexCount);
  gl.getBufferSubData(gl.TRANSFORM_FEEDBACK_BUFFER, 0, positions);
  return { rows: rows !== undefined, worst: worstOf(positions, frame) };
}

const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

/** Milliseconds that a frame takes of this thread, however many vertices it has; over many, for clocks are coarse. */
globalThis.measureTake = async (url) => {
  const { mesh, renderer, scene, camera } = await openMesh(url, true);
  await untilFrame(mesh.player, 5);
  renderer.render(scene, camera);
  const spent = [];
  for (let i = 0; i < 40; ++i) {
    const before = performance.now();
    for (let j = 0; j < 10; ++j) mesh.takeFrame();
    spent.push((performance.now() - before) / 10);
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
  const { components } = mesh.player.frame.planes;
  mesh.dispose();
  renderer.dispose();
  return { take: median(spent), components };
};

/** Milliseconds of a frame: the CPU's with and without the GPU's help, and until a picture is there. */
globalThis.measure = async (url) => {
  const result = {};
  for (const useGpu of [false, true]) {
    const { mesh, renderer, scene, camera } = await openMesh(url, useGpu);
    const { player } = mesh;
    const frames = 40;
    const [cpu, drawn] = [[], []];
    let planes;
    let uploads = 0;
    mesh.geometry.computeBoundingSphere();
    lookAt(camera, mesh.geometry.boundingSphere);
    const pixel = new Uint8Array(4);
    const gl = renderer.getContext();
    for (let number = 1; number <= frames; ++number) {
      await untilFrame(player, number);
      uploads += player.frame.planes === planes ? 0 : 1;
      ({ planes } = player.frame);
      renderer.render(scene, camera);
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      // Once more: what a frame takes of this thread, and of the GPU until it is drawn.
      const before = performance.now();
      mesh.takeFrame();
      const taken = performance.now();
      renderer.render(scene, camera);
      const called = performance.now();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      const done = performance.now();
      cpu.push([taken - before, called - taken]);
      drawn.push(done - before);
    }
    result[useGpu ? "gpu" : "positions"] = {
      take: median(cpu.map(([take]) => take)),
      render: median(cpu.map(([, render]) => render)),
      drawn: median(drawn),
      bytes: useGpu ? player.frame.rows.byteLength : player.frame.positions.byteLength * 2,
      components: planes?.components,
      uploads,
    };
    mesh.dispose();
    renderer.dispose();
  }
  return result;
};
