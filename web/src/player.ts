import type { StreamSource } from "./byte_source.js";
import { TvgError } from "./errors.js";
import { type FeedHost, LocalHost, nextFeedId } from "./feed.js";
import type { FeedAnswer, FeedFrame, FeedMesh } from "./feed_messages.js";
import { compileModule, type ModuleSource } from "./module.js";
import type { DamageInfo, DecoderLimits, StreamInfo } from "./types.js";

export interface PlayerOptions {
  /** Where frames are decoded: this thread unless it is given. */
  host?: FeedHost;
  /** tvg.wasm; the one beside this file unless it is given. */
  wasm?: ModuleSource;
  limits?: DecoderLimits;
  headers?: Record<string, string>;
  /** Frames that are decoded ahead of the one shown; 8 unless set. */
  ahead?: number;
}

/**
 * Events have HTMLMediaElement's names and meaning: loadedmetadata, canplay, play, pause, playing, waiting, seeking,
 * seeked, timeupdate, durationchange, ratechange, ended, error; and "mesh" and "frame" for who draws, "damage" where
 * frames are lost.
 */
export class TvgPlayer extends EventTarget {
  /** Whether it starts over at the end. */
  get loop(): boolean {
    return this.loops;
  }
  set loop(on: boolean) {
    this.loops = on;
    this.host.send({ type: "loop", id: this.id, on });
  }
  playbackRate = 1;
  paused = true;
  ended = false;
  seeking = false;
  /** What ended it. */
  error: TvgError | undefined;
  /** Frames that were lost last. */
  lastDamage: DamageInfo | undefined;
  info: StreamInfo | undefined;
  metadata: ReadonlyMap<string, string> = new Map();
  frameRate = 30;
  /** The frame to be drawn, and its mesh. */
  frame: FeedFrame | undefined;
  mesh: FeedMesh | undefined;

  private readonly id = nextFeedId();
  private readonly host: FeedHost;
  private readonly ahead: number;
  private queue: (FeedFrame | FeedMesh)[] = [];
  private time = 0;
  private lap = 0;
  private turn = 0;
  private frames: number | undefined;
  private waits = true;
  private loops = false;
  private closed = false;
  private toldCanPlay = false;
  private allHere = false;

  constructor(source: StreamSource, options: PlayerOptions = {}) {
    super();
    this.host = options.host ?? new LocalHost();
    this.ahead = Math.max(2, options.ahead ?? 8);
    void this.open(source, options);
  }

  /** In seconds; setting it seeks. */
  get currentTime(): number {
    return this.time;
  }
  set currentTime(seconds: number) {
    const last = this.frames === undefined ? Infinity : Math.max(0, this.frames - 1);
    const frame = Math.min(Math.max(0, Math.floor(seconds * this.frameRate + 1e-6)), last);
    this.time = frame / this.frameRate;
    this.seeking = this.waits = true;
    this.ended = this.allHere = false;
    this.lap = 0;
    const dropped = this.queue.filter(isFrame).length;
    // A mesh that came with frames dropped is the one that frames to come belong to.
    const mesh = this.queue.filter((entry) => !isFrame(entry)).pop();
    this.queue = mesh ? [mesh] : [];
    this.host.send({ type: "seek", id: this.id, frame, turn: ++this.turn });
    if (dropped > 0) this.host.send({ type: "take", id: this.id, frames: dropped });
    this.tell("seeking");
  }
  /** In seconds; NaN until it is known. */
  get duration(): number {
    return this.frames === undefined ? NaN : this.frames / this.frameRate;
  }
  /** The end of what is decoded ahead, in seconds. */
  get bufferedTime(): number {
    const last = this.queue.filter(isFrame).filter(({ lap }) => lap === this.lap).pop() ?? this.frame;
    return last ? (last.number + 1) / this.frameRate : 0;
  }

  play(): void {
    if (!this.paused || this.closed) return;
    if (this.ended) this.currentTime = 0;
    this.paused = false;
    this.tell("play");
  }
  pause(): void {
    if (this.paused) return;
    this.paused = true;
    this.tell("pause");
  }

  /** Moves the clock on by so many seconds, and what is to be drawn with it; to be called before each picture. */
  update(seconds: number): void {
    if (this.error || this.closed) return;
    if (!this.paused && !this.waits) this.time += Math.min(seconds, 0.25) * this.playbackRate;
    const length = this.duration;
    if (this.time >= length && !this.seeking) {
      if (this.loops) {
        this.time %= length;
        ++this.lap;
      } else {
        this.time = length;
      }
    }
    this.show();
  }

  /** Ends requests and gives the decoder's memory back. */
  dispose(): void {
    if (this.closed) return;
    this.closed = true;
    this.host.send({ type: "close", id: this.id });
    this.queue = [];
  }

  private async open(source: StreamSource, options: PlayerOptions): Promise<void> {
    const { id } = this;
    try {
      const code = await compileModule(options.wasm);
      if (this.closed) return;
      const { limits, headers } = options;
      const url = typeof source === "string" || source instanceof URL ? absolute(source) : source;
      const request = { type: "open" as const, id, source: url, code, ...(limits && { limits }), ...(headers && { headers }) };
      this.host.open(id, request, (answer) => this.answer(answer));
      this.host.send({ type: "loop", id, on: this.loops });
      this.host.send({ type: "take", id, frames: this.ahead });
      if (this.turn > 0) this.currentTime = this.time;
    } catch (error) {
      this.fail(error instanceof TvgError ? error : new TvgError("io", (error as Error).message));
    }
  }

  private answer(answer: FeedAnswer): void {
    if (this.closed) return;
    switch (answer.type) {
      case "head":
        this.info = answer.info;
        this.metadata = new Map(answer.metadata);
        this.frameRate = answer.frameRate;
        this.setFrames(answer.info.frameCount);
        this.tell("loadedmetadata");
        break;
      case "mesh":
        this.queue.push(answer.mesh);
        break;
      case "frame":
        if (answer.frame.turn === this.turn) this.queue.push(answer.frame);
        else this.host.send({ type: "take", id: this.id, frames: 1 });
        if (this.seeking || this.frame === undefined) this.show();
        break;
      case "damage":
        this.lastDamage = answer.damage;
        this.tell("damage");
        break;
      case "end":
        this.setFrames(answer.frameCount);
        if (answer.turn === this.turn) this.allHere = true;
        break;
      case "error":
        this.fail(TvgError.from(answer));
        break;
    }
  }

  /** Draws the newest frame whose time has come, and tells when there is none to go on with. */
  private show(): void {
    const wanted = Math.floor(this.time * this.frameRate + 1e-6);
    const news: string[] = [];
    let shown = 0;
    while (this.queue.length > 0) {
      const next = this.queue[0]!;
      if (isFrame(next)) {
        const due = next.lap < this.lap || (next.lap === this.lap && next.number <= wanted);
        if (!due && !this.seeking && this.frame) {
          // Frames in between are lost: the clock goes on.
          if (this.waits) this.settle(news);
          break;
        }
        this.frame = next;
        ++shown;
        if (this.seeking) this.time = Math.max(this.time, next.number / this.frameRate);
        this.settle(news);
      } else {
        this.mesh = next;
        this.tell("mesh");
      }
      this.queue.shift();
    }
    if (shown > 0) {
      this.host.send({ type: "take", id: this.id, frames: shown });
      this.tell("frame");
      this.tell("timeupdate");
    }
    // Told last: by then who draws has the frame.
    for (const name of news) this.tell(name);
    this.judge(wanted);
  }

  /** There is a frame to show: what that means goes to `news`. */
  private settle(news: string[]): void {
    const { waits, seeking } = this;
    this.waits = this.seeking = false;
    if (seeking) news.push("seeked");
    if (waits && !this.toldCanPlay) news.push("canplay");
    this.toldCanPlay = true;
    if (waits && !this.paused) news.push("playing");
  }

  private judge(wanted: number): void {
    if (this.seeking || this.frame === undefined) return;
    const isLast = this.frames !== undefined && this.time >= this.duration;
    if (isLast && !this.loops && !this.ended) {
      this.ended = this.paused = true;
      this.tell("ended");
    }
    const isBehind = this.queue.length === 0 && (this.frame.lap < this.lap || this.frame.number < wanted);
    if (!isBehind || this.waits || this.ended || (this.allHere && !this.loops)) return;
    this.waits = true;
    this.tell("waiting");
  }

  private setFrames(frames: number | undefined): void {
    if (frames === undefined || frames === this.frames) return;
    this.frames = frames;
    this.tell("durationchange");
  }
  private fail(error: TvgError): void {
    this.error = error;
    this.paused = true;
    this.tell("error");
  }
  private tell(name: string): void {
    this.dispatchEvent(new Event(name));
  }
}

function isFrame(entry: FeedFrame | FeedMesh): entry is FeedFrame {
  return "positions" in entry;
}

/** A worker that was made from a blob has no address that others could be relative to. */
function absolute(source: string | URL): string {
  return new URL(source, typeof document !== "undefined" ? document.baseURI : undefined).href;
}
