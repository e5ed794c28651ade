// What compare.mjs measures on its page: milliseconds to the first picture, with decoders fetched on the way; and for
// every further frame what decoding takes, wherever it runs, and what is left to the main thread before it draws.
import * as THREE from "three";
import { DRACOLoader } from "three/addons/loaders/DRACOLoader.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";
import { TvgStream } from "tvg";
import { TVGLoader } from "tvg/three";

const renderer = new THREE.WebGLRenderer({ canvas: document.getElementById("view") });
const camera = new THREE.PerspectiveCamera(40, 4 / 3, 0.01, 1000);
const scene = new THREE.Scene().add(new THREE.HemisphereLight(0xffffff, 0x445566, 3));
const draw = () => renderer.render(scene, camera);
const mean = (values) => values.reduce((sum, value) => sum + value, 0) / Math.max(1, values.length);
const nextPicture = () => new Promise((resolve) => requestAnimationFrame(resolve));

async function timed(action) {
  const begun = performance.now();
  await action();
  return performance.now() - begun;
}

async function stream(file, onGpu) {
  const begun = performance.now();
  const loader = new TVGLoader();
  if (onGpu) loader.detectSupport(renderer);
  const mesh = await loader.loadAsync(file);
  mesh.update();
  scene.add(mesh);
  draw();
  const firstFrame = performance.now() - begun;
  return {
    firstFrame,
    steady: async () => {
      // As the page has it, but for its clock: each picture shows the next frame.
      const mainThread = [];
      const step = 1000 / mesh.player.frameRate;
      mesh.play();
      for (let now = performance.now(), shown = -1; !mesh.ended; now += step) {
        mainThread.push(await timed(() => mesh.update(now)));
        if (mesh.player.frame.number === shown) mainThread.pop();
        shown = mesh.player.frame.number;
        draw();
        await nextPicture();
      }
      return { decoding: await decoding(file, onGpu), mainThread: mean(mainThread) };
    },
  };
}

/** Of a frame with its normals, on this thread; of its rows alone where the GPU makes the rest. */
async function decoding(file, rowsOnly) {
  const bytes = new Uint8Array(await (await fetch(file)).arrayBuffer());
  const stream = await TvgStream.open(bytes);
  let positions, normals;
  let frames = 0;
  const total = await timed(async () => {
    for (let event; (event = await stream.next()) !== "end"; ) {
      if (event === "mesh") positions = new Float32Array(3 * stream.decoder.view().vertexCount);
      normals ??= new Float32Array(positions.length);
      if (event !== "frame") continue;
      ++frames;
      if (rowsOnly) continue;
      stream.decoder.copyViewPositions(positions);
      stream.decoder.computeViewNormals(normals);
    }
  });
  stream.dispose();
  return total / frames;
}

async function draco(files) {
  const begun = performance.now();
  const loader = new DRACOLoader().setDecoderPath("node_modules/three/examples/jsm/libs/draco/").setWorkerLimit(1);
  const mesh = new THREE.Mesh(await loader.loadAsync(files[0]), new THREE.MeshStandardMaterial());
  mesh.geometry.computeVertexNormals();
  scene.add(mesh);
  draw();
  const firstFrame = performance.now() - begun;
  return {
    firstFrame,
    steady: async () => {
      const bytes = await Promise.all(files.map(async (file) => (await fetch(file)).arrayBuffer()));
      const decoding = [];
      const mainThread = [];
      for (const frame of bytes) {
        let geometry;
        decoding.push(await timed(async () => (geometry = await new Promise((done, fail) => loader.parse(frame, done, fail)))));
        mainThread.push(
          await timed(() => {
            mesh.geometry.dispose();
            mesh.geometry = geometry;
            geometry.computeVertexNormals();
          }),
        );
        draw();
      }
      return { decoding: mean(decoding), mainThread: mean(mainThread) };
    },
  };
}

async function morph() {
  const begun = performance.now();
  const { scene: model, animations } = await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).loadAsync("morph.glb");
  const mixer = new THREE.AnimationMixer(model);
  for (const clip of animations) mixer.clipAction(clip).play();
  scene.add(model);
  mixer.update(0);
  draw();
  const firstFrame = performance.now() - begun;
  return {
    firstFrame,
    steady: async () => {
      const mainThread = [];
      for (let frame = 0; frame < 100; ++frame) {
        mainThread.push(await timed(() => mixer.update(1 / 30)));
        draw();
        await nextPicture();
      }
      return { decoding: 0, mainThread: mean(mainThread) };
    },
  };
}

globalThis.measure = async (way, frames, onlyFirst) => {
  const begun = way === "draco" ? draco(frames) : way === "morph" ? morph() : stream(`${way.split(" ")[0]}.tvg`, way.endsWith("GPU"));
  const { firstFrame, steady } = await begun;
  return { firstFrame, ...(onlyFirst ? {} : await steady()) };
};
