import type { TVGMesh } from "../src/three/tvg_mesh.js";
import type { Stage } from "./stage.js";

const element = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;

/** Seconds behind the newest frame that still count as live: groups of frames come all at once. */
const kNearLive = 1.5;

/** The bar below the picture, and the keys. */
export class Bar {
  private readonly root = element("player");
  private readonly playButton = element<HTMLButtonElement>("play");
  private readonly scrub = element<HTMLInputElement>("scrub");
  private readonly buffered = element("buffered");
  private readonly time = element<HTMLOutputElement>("time");
  private readonly rate = element<HTMLSelectElement>("rate");
  private readonly liveButton = element<HTMLButtonElement>("live");
  private shown = "";
  /** Whether the mesh is drawn as wires. */
  wires = false;

  constructor(
    private readonly mesh: TVGMesh,
    /** Undefined where there is no WebGL. */
    private readonly stage: Stage | undefined,
  ) {
    const { player } = mesh;
    player.addEventListener("durationchange", () => (this.scrub.max = String(this.lastFrame)));
    for (const event of ["play", "pause", "ended", "error"]) player.addEventListener(event, () => this.showPlaying());
    this.playButton.onclick = () => this.toggle();
    this.scrub.oninput = () => this.goTo(Number(this.scrub.value));
    this.rate.onchange = () => (player.playbackRate = Number(this.rate.value));
    element("full").onclick = () => this.fullScreen();
    element("full").hidden = !document.fullscreenEnabled;
    this.liveButton.onclick = () => {
      player.goLive();
      player.play();
    };
    this.bindToggle("loop", (on) => (player.loop = on));
    this.bindToggle("wire", (on) => (this.wires = on));
    this.bindToggle("importance", (on) => (mesh.importance = on));
    player.loop = !player.live;
    this.root.classList.toggle("live", player.live);
    this.liveButton.hidden = !player.live;
    addEventListener("keydown", (event) => this.press(event));
  }

  /** Shows where the clock is and what is there already; before each picture. */
  update(): void {
    const { player } = this.mesh;
    for (const material of this.mesh.material) Object.assign(material, { wireframe: this.wires });
    const shown = JSON.stringify([player.frame?.number, player.duration, ...this.stretches(), player.behind.toFixed(1)]);
    if (shown === this.shown) return;
    this.shown = shown;
    if (player.live) this.showBehind();
    else this.showTime();
  }

  private showTime(): void {
    const { player } = this.mesh;
    const number = player.frame?.number ?? 0;
    this.scrub.value = String(number);
    this.scrub.setAttribute("aria-valuetext", `frame ${number + 1} of ${this.lastFrame + 1}`);
    const length = player.duration;
    this.time.value = Number.isFinite(length) ? `${player.currentTime.toFixed(1)} / ${length.toFixed(1)} s` : "";
    const pieces = this.stretches().map(([from, to]) => piece("i", from, to));
    const played = this.lastFrame > 0 ? number / this.lastFrame : 0;
    this.buffered.replaceChildren(...pieces, piece("b", 0, played));
  }

  /** What is there already, in shares of the whole. */
  private stretches(): [number, number][] {
    const { buffered, duration } = this.mesh;
    if (!(duration > 0) || !Number.isFinite(duration)) return [];
    return Array.from({ length: buffered.length }, (_, i) => [buffered.start(i) / duration, buffered.end(i) / duration]);
  }

  private showBehind(): void {
    const { behind } = this.mesh.player;
    const isNow = behind <= kNearLive && !this.mesh.paused;
    this.liveButton.classList.toggle("now", isNow);
    this.liveButton.querySelector("span")!.textContent = isNow ? "Live" : "Go to live";
    this.time.value = `${behind.toFixed(1)} s behind`;
  }

  private get lastFrame(): number {
    const { duration, frameRate } = this.mesh.player;
    return Number.isFinite(duration) ? Math.max(0, Math.round(duration * frameRate) - 1) : 0;
  }

  private goTo(frame: number): void {
    const { player } = this.mesh;
    if (!player.live) player.currentTime = Math.min(Math.max(0, frame), this.lastFrame || Infinity) / player.frameRate;
  }

  private toggle(): void {
    if (this.mesh.paused) this.mesh.play();
    else this.mesh.pause();
  }

  private fullScreen(): void {
    if (document.fullscreenElement) void document.exitFullscreen();
    else void this.root.requestFullscreen();
  }

  private showPlaying(): void {
    this.playButton.classList.toggle("playing", !this.mesh.paused);
    this.playButton.setAttribute("aria-label", this.mesh.paused ? "Play" : "Pause");
  }

  private bindToggle(id: string, apply: (on: boolean) => void): void {
    const button = element<HTMLButtonElement>(id);
    button.onclick = () => {
      const on = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", String(on));
      apply(on);
      this.stage?.refresh();
    };
  }

  private press(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target as HTMLElement;
    const isControl = target.matches("button, input, select");
    const belongsToControl = isControl && [" ", "Enter", "Home", "End"].includes(event.key);
    const action = this.action(event.key, target.id === "view");
    if (!action || belongsToControl) return;
    event.preventDefault();
    action();
  }

  private action(key: string, isView: boolean): (() => void) | undefined {
    const { stage } = this;
    const frame = this.mesh.player.frame?.number ?? 0;
    const keys: Record<string, () => void> = {
      " ": () => this.toggle(),
      k: () => this.toggle(),
      ",": () => this.goTo(frame - 1),
      ".": () => this.goTo(frame + 1),
      Home: () => this.goTo(0),
      End: () => this.goTo(this.lastFrame),
      f: () => this.fullScreen(),
      w: () => element("wire").click(),
      l: () => element("loop").click(),
      i: () => element("importance").click(),
    };
    const viewKeys: Record<string, () => void> = {
      ArrowLeft: () => stage?.orbit(-0.15, 0),
      ArrowRight: () => stage?.orbit(0.15, 0),
      ArrowUp: () => stage?.orbit(0, -0.15),
      ArrowDown: () => stage?.orbit(0, 0.15),
      "+": () => stage?.zoom(0.9),
      "-": () => stage?.zoom(1.1),
    };
    return keys[key] ?? (isView ? viewKeys[key] : undefined);
  }
}

function piece(tag: "i" | "b", from: number, to: number): HTMLElement {
  const made = document.createElement(tag);
  made.style.left = `${100 * from}%`;
  made.style.width = `${100 * (Math.min(1, to) - from)}%`;
  return made;
}
