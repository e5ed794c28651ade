import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { LocalHost, TvgPlayer, WorkerHost } from "../src/index.js";
import { TVGMesh } from "../src/three/tvg_mesh.js";
import { decoderSource, embeddedFile } from "./embedded.js";

/** The worker's script, which the bundler puts here: the page needs no further file for it. */
declare const WORKER_SCRIPT: string;

const element = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;
const root = element("player");
const canvas = element<HTMLCanvasElement>("view");
const status = element("status");
const playButton = element<HTMLButtonElement>("play");
const scrub = element<HTMLInputElement>("scrub");
const buffered = element<HTMLProgressElement>("buffered");
const time = element<HTMLOutputElement>("time");
const rate = element<HTMLSelectElement>("rate");
const loop = element<HTMLInputElement>("loop");
const wire = element<HTMLInputElement>("wire");

function newHost(): WorkerHost | LocalHost {
  try {
    return new WorkerHost(new Worker(URL.createObjectURL(new Blob([WORKER_SCRIPT], { type: "text/javascript" }))));
  } catch {
    return new LocalHost();
  }
}

const streamName = root.dataset.stream ?? "clip.tvg";
const player = new TvgPlayer(embeddedFile(streamName) ?? streamName, { host: newHost(), wasm: decoderSource() });
const mesh = new TVGMesh(player);

const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(40, 1, 0.01, 1000);
const light = new THREE.DirectionalLight(0xffffff, 2.2);
camera.add(light);
light.position.set(0.4, 0.6, 1);
scene.add(camera, new THREE.HemisphereLight(0xffffff, 0x8888a0, 1.4), mesh);
mesh.frustumCulled = false;

function tell(text: string, isError = false): void {
  status.textContent = text;
  status.classList.toggle("error", isError);
}

let renderer: THREE.WebGLRenderer | undefined;
let controls: OrbitControls | undefined;
try {
  renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  controls = new OrbitControls(camera, canvas);
} catch {
  tell("This browser has no WebGL, which the animation is drawn with.", true);
}

/** Puts the first frame into the middle of the picture. */
function frameView(): void {
  mesh.geometry.computeBoundingSphere();
  const { center, radius } = mesh.geometry.boundingSphere!;
  if (player.metadata.get("up") === "z") camera.up.set(0, 0, 1);
  const size = Math.max(radius, 1e-6);
  const direction = camera.up.z === 1 ? new THREE.Vector3(0.5, -1, 0.35) : new THREE.Vector3(0.5, 0.35, 1);
  camera.position.copy(center).addScaledVector(direction.normalize(), 3.1 * size);
  camera.near = size / 100;
  camera.far = size * 100;
  camera.updateProjectionMatrix();
  controls?.target.copy(center);
  controls?.update();
}

const lastFrame = (): number => Math.max(0, Math.round(player.duration * player.frameRate) - 1);
const shownFrame = (): number => player.frame?.number ?? 0;

player.addEventListener("durationchange", () => (scrub.max = String(lastFrame())));
player.addEventListener("canplay", () => {
  frameView();
  tell("");
  player.play();
});
player.addEventListener("waiting", () => tell("Waiting for data"));
player.addEventListener("playing", () => tell(damaged));
player.addEventListener("seeked", () => tell(damaged));
player.addEventListener("error", () => {
  const isFile = location.protocol === "file:";
  const hint = isFile ? " Browsers read streams from servers only: offer this folder over HTTP." : "";
  tell(`It cannot be played: ${player.error!.message}.${hint}`, true);
});
let damaged = "";
player.addEventListener("damage", () => {
  const { firstFrame, frameCount } = player.lastDamage!;
  damaged = `Damaged: ${frameCount} frames from ${firstFrame} on are missing`;
  tell(damaged);
});
for (const event of ["play", "pause", "ended"]) {
  player.addEventListener(event, () => {
    playButton.classList.toggle("playing", !player.paused);
    playButton.setAttribute("aria-label", player.paused ? "Play" : "Pause");
  });
}
player.addEventListener("timeupdate", () => {
  scrub.value = String(shownFrame());
  scrub.setAttribute("aria-valuetext", `frame ${shownFrame() + 1} of ${lastFrame() + 1}`);
  time.value = `${player.currentTime.toFixed(1)} / ${Number.isNaN(player.duration) ? "live" : player.duration.toFixed(1)} s`;
});

const goTo = (frame: number): void => {
  player.currentTime = Math.min(Math.max(0, frame), lastFrame() || Infinity) / player.frameRate;
};
const toggle = (): void => (player.paused ? player.play() : player.pause());
const fullScreen = (): void => {
  if (document.fullscreenElement) void document.exitFullscreen();
  else void root.requestFullscreen();
};
playButton.onclick = toggle;
scrub.oninput = () => goTo(Number(scrub.value));
rate.onchange = () => (player.playbackRate = Number(rate.value));
loop.onchange = () => (player.loop = loop.checked);
element("full").onclick = fullScreen;
player.loop = loop.checked;
player.addEventListener("mesh", showWires);
wire.onchange = showWires;
function showWires(): void {
  for (const material of mesh.material) (material as THREE.MeshStandardMaterial).wireframe = wire.checked;
}

/** Turns the view about the upright axis and to the top, in radians. */
function orbit(around: number, up: number): void {
  if (!controls) return;
  const offset = camera.position.clone().sub(controls.target);
  const side = new THREE.Vector3().crossVectors(camera.up, offset).normalize();
  offset.applyAxisAngle(camera.up, around).applyAxisAngle(side, up);
  camera.position.copy(controls.target).add(offset);
  controls.update();
}
function zoom(by: number): void {
  if (controls) camera.position.sub(controls.target).multiplyScalar(by).add(controls.target);
}
const viewKeys: Record<string, () => void> = {
  ArrowLeft: () => orbit(-0.15, 0),
  ArrowRight: () => orbit(0.15, 0),
  ArrowUp: () => orbit(0, -0.15),
  ArrowDown: () => orbit(0, 0.15),
  "+": () => zoom(0.9),
  "-": () => zoom(1.1),
};
const keys: Record<string, () => void> = {
  " ": toggle,
  k: toggle,
  ",": () => goTo(shownFrame() - 1),
  ".": () => goTo(shownFrame() + 1),
  Home: () => goTo(0),
  End: () => goTo(lastFrame()),
  f: fullScreen,
  w: () => wire.click(),
  l: () => loop.click(),
};
addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const isControl = (event.target as HTMLElement).matches("button, input, select");
  const action = isControl && (event.key === " " || event.key === "Home" || event.key === "End") ? undefined : keys[event.key];
  const run = action ?? (event.target === canvas ? viewKeys[event.key] : undefined);
  if (!run) return;
  event.preventDefault();
  run();
});

function draw(now: number): void {
  mesh.update(now);
  buffered.value = player.duration > 0 ? Math.min(1, player.bufferedTime / player.duration) : 0;
  const { clientWidth, clientHeight } = canvas;
  const size = renderer?.getSize(new THREE.Vector2());
  if (renderer && size && (size.x !== clientWidth || size.y !== clientHeight)) {
    renderer.setSize(clientWidth, clientHeight, false);
    camera.aspect = clientWidth / Math.max(1, clientHeight);
    camera.updateProjectionMatrix();
  }
  if (player.frame) renderer?.render(scene, camera);
  requestAnimationFrame(draw);
}
requestAnimationFrame(draw);

// For who scripts the page.
Object.assign(globalThis, { tvgPlayer: player });
