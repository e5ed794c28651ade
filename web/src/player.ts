import type { StreamSource } from "./byte_source.js";
import { kLeastGpuLimits } from "./basis_feed.js";
import { TvgError } from "./errors.js";
import { type FeedHost, LocalHost, nextFeedId } from "./feed.js";
import type { FeedAnswer, FeedFrame, FeedMesh, FeedPlanes, GpuLimits } from "./feed_messages.js";
import { FrameQueue, isFrame } from "./frame_queue.js";
import { compileModule, type ModuleSource } from "./module.js";
import type { StreamProgress } from "./stream.js";
import { FrameTimeRanges, type TimeRangesLike } from "./time_ranges.js";
import type { DamageInfo, DecoderLimits, FreeFormData, StreamInfo } from "./types.js";

export interface PlayerOptions {
  /** Where frames are decoded: this thread unless it is given. */
  host?: FeedHost;
  /** tvg.wasm; the one beside this file unless it is given. */
  wasm?: ModuleSource;
  limits?: DecoderLimits;
  headers?: Record<string, string>;
  /** Frames that are decoded ahead of the one shown; 8 unless set. */
  ahead?: number;
  /** Bytes of a URL that are kept, so that loops do not fetch them again; 64 MiB unless set. */
  cacheBytes?: number;
  /** The stream is sent as it is made, and never ends by itself: `GET /live/NAME` of `tvg serve`. */
  live?: boolean;
  /** Seconds that a live stream that plays may fall behind before it goes to the newest frames; 3 unless set. */
  mostBehind?: number;
  /** What TvgPlayer.gpu is at first: true for what every WebGL2 has. */
  gpu?: boolean | GpuLimits;
}

/** Of a live stream that does not play: seconds and bytes of frames kept at most. */
const kKeptSeconds = 10;
const kKeptBytes = 1 << 28;

/**
 * Events have HTMLMediaElement's names and meaning: loadedmetadata, canplay, play, pause, playing, waiting, seeking,
 * seeked, timeupdate, durationchange, progress, ended, error; and "mesh" and "frame" for who draws, "data" for what goes
 * along (materials, pictures), "damage" where frames are lost.
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
  /** Whether frames come with the importance of vertices, in `flags`; asks for the frame shown once more. */
  get wantsFlags(): boolean {
    return this.flagsWanted;
  }
  set wantsFlags(on: boolean) {
    if (on === this.flagsWanted) return;
    this.flagsWanted = on;
    this.flags = undefined;
    this.host.send({ type: "flags", id: this.id, on });
    if (on && !this.live && this.frame) this.currentTime = this.time;
  }
  /**
   * Whether frames in mode "basis" come as `rows` and `planes` for a GPU to make, where these are within the limits;
   * all others come as positions still.
   */
  get gpu(): GpuLimits | undefined {
    return this.gpuLimits;
  }
  set gpu(limits: GpuLimits | undefined) {
    this.gpuLimits = limits;
    this.host.send({ type: "gpu", id: this.id, limits });
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
  /** Importance of each render vertex of the frame, 0 or 1; undefined until it has come. */
  flags: Uint8Array | undefined;
  /** What goes along with the stream, by its name. */
  readonly data = new Map<string, FreeFormData>();
  /** How far the stream has been fetched. */
  progress: StreamProgress | undefined;
  readonly live: boolean;

  private id = nextFeedId();
  private readonly host: FeedHost;
  private readonly ahead: number;
  private readonly queue = new FrameQueue();
  private time = 0;
  private lap = 0;
  private turn = 0;
  private frames: number | undefined;
  private waits = true;
  private loops = false;
  private flagsWanted = false;
  private gpuLimits: GpuLimits | undefined;
  /** Those of the frames that come. */
  private planes: FeedPlanes | undefined;
  /** The newest frame that came. */
  private newest: FeedFrame | undefined;
  private readonly mostBehind: number;
  private closed = false;
  private toldCanPlay = false;
  private allHere = false;

  /** A source whose name ends in ".json" is the manifest of a ladder: the same frames in several qualities. */
  constructor(
    private readonly source: StreamSource,
    private readonly options: PlayerOptions = {},
  ) {
    super();
    this.host = options.host ?? new LocalHost();
    this.ahead = Math.max(2, options.ahead ?? 8);
    this.live = options.live ?? false;
    this.mostBehind = options.mostBehind ?? 3;
    this.gpuLimits = options.gpu === true ? kLeastGpuLimits : options.gpu || undefined;
    void this.open();
  }

  /** In seconds; setting it seeks, in a live stream among the frames that are there. */
  get currentTime(): number {
    return this.time;
  }
  set currentTime(seconds: number) {
    const last = this.frames === undefined ? Infinity : Math.max(0, this.frames - 1);
    const frame = Math.min(Math.max(0, Math.floor(seconds * this.frameRate + 1e-6)), last);
    this.time = frame / this.frameRate;
    this.seeking = this.waits = true;
    this.lap = 0;
    if (this.live) {
      this.queue.skipTo(frame);
    } else {
      this.ended = this.allHere = false;
      // For who waits no longer for the frames dropped, as many others may come.
      const frames = this.queue.clear();
      this.host.send({ type: "seek", id: this.id, frame, turn: ++this.turn });
      if (frames > 0) this.host.send({ type: "take", id: this.id, frames });
    }
    this.tell("seeking");
  }
  /** In seconds; NaN until it is known, Infinity of a live stream. */
  get duration(): number {
    return this.frames === undefined ? (this.live ? Infinity : NaN) : this.frames / this.frameRate;
  }
  /** What is there already: fetched, by the stream's index, or decoded. */
  get buffered(): TimeRangesLike {
    const frames: [number, number][] = [...(this.progress?.frames ?? [])];
    const last = this.queue.last(this.lap) ?? this.frame;
    if (this.frame && last) frames.push([Math.min(this.frame.number, last.number), last.number + 1]);
    return new FrameTimeRanges(frames, this.frameRate);
  }
  /** Of a live stream: seconds from the frame shown to the newest that came. */
  get behind(): number {
    if (!this.live || !this.newest || !this.frame) return 0;
    return (this.newest.number - this.frame.number) / this.frameRate;
  }

  /** Of a live stream: shows the newest group of frames. */
  goLive(): void {
    if (this.live && this.newest) this.currentTime = this.newest.gop / this.frameRate;
  }
  /** Begins again after an error, where it was; a live stream with what is newest. */
  load(): void {
    if (this.closed) return;
    this.host.send({ type: "close", id: this.id });
    this.id = nextFeedId();
    this.error = this.newest = undefined;
    this.ended = this.allHere = this.toldCanPlay = false;
    this.queue.clear();
    if (this.live) this.frames = this.frame = undefined;
    this.waits = true;
    ++this.turn;
    void this.open();
  }

  play(): void {
    if (!this.paused || this.closed) return;
    if (this.ended && !this.live) this.currentTime = 0;
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
    if (this.live && !this.paused && this.behind > this.mostBehind) this.goLive();
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
    this.queue.clear();
  }

  private async open(): Promise<void> {
    const { id, source } = this;
    try {
      const code = await compileModule(this.options.wasm);
      if (this.closed || id !== this.id) return;
      const { limits, headers, live, cacheBytes } = this.options;
      const url = typeof source === "string" || source instanceof URL ? absolute(source) : source;
      const request = {
        type: "open" as const,
        id,
        source: url,
        code,
        ...(limits && { limits }),
        ...(headers && { headers }),
        ...(live && { live }),
        ...(cacheBytes !== undefined && { cacheBytes }),
      };
      this.host.open(id, request, (answer) => id === this.id && this.answer(answer));
      this.host.send({ type: "flags", id, on: this.flagsWanted });
      this.host.send({ type: "gpu", id, limits: this.gpuLimits });
      this.host.send({ type: "loop", id, on: this.loops });
      this.host.send({ type: "take", id, frames: this.ahead });
      if (this.turn > 0 && !this.live) this.currentTime = this.time;
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
      case "length":
        this.setFrames(answer.frameCount);
        break;
      case "progress":
        this.progress = answer.progress;
        this.tell("progress");
        break;
      case "data":
        this.data.set(answer.data.name, answer.data);
        this.tell("data");
        break;
      case "mesh":
        this.queue.push(answer.mesh);
        break;
      case "planes":
        this.planes = answer.planes;
        break;
      case "frame":
        if (answer.frame.rows && this.planes) answer.frame.planes = this.planes;
        if (this.live || answer.frame.turn === this.turn) this.take(answer.frame);
        else this.host.send({ type: "take", id: this.id, frames: 1 });
        if (this.seeking || this.frame === undefined) this.show();
        break;
      case "damage":
        this.lastDamage = answer.damage;
        this.tell("damage");
        break;
      case "end":
        this.setFrames(answer.frameCount);
        if (this.live || answer.turn === this.turn) this.allHere = true;
        break;
      case "error":
        this.fail(TvgError.from(answer));
        break;
    }
  }

  private take(frame: FeedFrame): void {
    this.queue.push(frame);
    this.newest = frame;
    if (this.live) this.queue.trim(kKeptSeconds * this.frameRate, kKeptBytes);
  }

  /** Draws the newest frame whose time has come, and tells when there is none to go on with. */
  private show(): void {
    const wanted = Math.floor(this.time * this.frameRate + 1e-6);
    const news: string[] = [];
    let shown = 0;
    for (let next = this.queue.first; next; next = this.queue.first) {
      if (isFrame(next)) {
        const due = next.lap < this.lap || (next.lap === this.lap && next.number <= wanted);
        if (!due && !this.seeking && this.frame) {
          // Frames in between are lost: the clock goes on.
          if (this.waits) this.settle(news);
          break;
        }
        this.frame = next;
        this.flags = next.flags ?? this.flags;
        ++shown;
        // A live stream begins where it is when one comes to it.
        if (this.seeking || (this.live && this.waits)) this.time = Math.max(this.time, next.number / this.frameRate);
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
    const isBehind = this.queue.isEmpty && (this.frame.lap < this.lap || this.frame.number < wanted);
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

/** A worker that was made from a blob has no address that others could be relative to. */
function absolute(source: string | URL): string {
  return new URL(source, typeof document !== "undefined" ? document.baseURI : undefined).href;
}
