import { TvgPlayer } from "../src/index.js";
import { TVGMesh } from "../src/three/tvg_mesh.js";
import { Bar } from "./bar.js";
import { decoderSource, embeddedFile } from "./embedded.js";
import { PageHost } from "./host.js";
import { Notice } from "./notice.js";
import { sourceOf } from "./source.js";
import { Stage } from "./stage.js";

/** The worker's script, which the bundler puts here: the page needs no further file for it. */
declare const WORKER_SCRIPT: string;

const root = document.getElementById("player")!;
const source = sourceOf(root, location);
const player = new TvgPlayer(embeddedFile(source.url) ?? source.url, {
  host: new PageHost(WORKER_SCRIPT),
  wasm: decoderSource(),
  live: source.isLive,
});
const mesh = new TVGMesh(player);
const notice = new Notice(() => {
  notice.wait();
  player.load();
});
let stage: Stage | undefined;
try {
  stage = new Stage(document.getElementById("view") as HTMLCanvasElement, mesh);
} catch {
  notice.stop("No WebGL", "This browser has no WebGL, which the animation is drawn with.", undefined);
}
const bar = new Bar(mesh, stage);

if (source.title) {
  document.title = source.title;
  const title = document.getElementById("title")!;
  title.textContent = source.title;
  title.hidden = false;
}
if (source.poster) notice.showPoster(source.poster);

/** Whether the camera has found its place: it stays there when the stream is opened again. */
let fitted = false;
player.addEventListener("canplay", () => {
  notice.goOn();
  notice.clear();
  if (stage) stage.bottom = innerHeight - document.getElementById("bar")!.offsetTop;
  if (!fitted) stage?.fit(player.metadata.get("up") === "z");
  fitted = true;
  void mesh.ready.then(() => stage?.refresh());
  player.play();
});
/** When it was last looked whether the mesh is still in the picture, and how often that is done. */
let looked = 0;
const kLookMs = 500;
player.addEventListener("frame", () => {
  stage?.refresh();
  if (!fitted || performance.now() - looked < kLookMs) return;
  looked = performance.now();
  stage?.keepInView();
});
player.addEventListener("progress", () => {
  if (notice.waits && !player.frame) notice.wait(player.progress?.firstFrames);
});
player.addEventListener("waiting", () => notice.wait());
for (const event of ["playing", "seeked"]) player.addEventListener(event, () => notice.goOn());
player.addEventListener("damage", () => {
  const { firstFrame, frameCount } = player.lastDamage!;
  const which = frameCount > 1 ? `${frameCount} frames from ${firstFrame} on are` : `frame ${firstFrame} is`;
  notice.say(frameCount > 0 ? `Damaged: ${which} missing` : "Damaged: what is shown may be wrong", true);
});
player.addEventListener("ended", () => {
  if (source.isLive) notice.stop("The live stream has ended", "Whoever sent it has stopped.", "Join again");
});
player.addEventListener("error", () => {
  // Where in the stream it is, which the text ends with, helps nobody here.
  const message = player.error!.message.replace(/ \[[^\]]*\]$/, "");
  const text = message.charAt(0).toUpperCase() + message.slice(1);
  const isFile = location.protocol === "file:";
  const hint = isFile ? " Browsers read streams from servers only: offer this folder over HTTP." : "";
  const title = source.isLive ? `${source.title} cannot be watched` : "This animation cannot be played";
  notice.stop(title, `${text}.${hint}`, "Retry");
});

let first = true;
function draw(now: number): void {
  mesh.update(now);
  bar.update();
  stage?.draw();
  if (first && player.frame && fitted) {
    first = false;
    // Not before the browser has put the frame on the screen.
    requestAnimationFrame(() => notice.hidePoster());
  }
  requestAnimationFrame(draw);
}
notice.wait();
requestAnimationFrame(draw);

// For who scripts the page.
Object.assign(globalThis, { tvgPlayer: player, tvgMesh: mesh, tvgStage: stage });
