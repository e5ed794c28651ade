import { type ByteSource, type FetchOptions, openSource, type StreamSource } from "./byte_source.js";
import { Decoder } from "./decoder.js";
import { TvgError } from "./errors.js";
import { FrameTable } from "./frame_table.js";
import { ConnectionError } from "./http_source.js";
import { TvgModule } from "./module.js";
import { kTailBytes } from "./names.js";
import type { DamageInfo, DecoderLimits, FreeFormData } from "./types.js";

export interface StreamOptions extends FetchOptions {
  /** An instance to decode with; one is loaded for this stream unless it is given. */
  module?: TvgModule;
  limits?: DecoderLimits;
  /** Whether the index is fetched first, by a request of its own; true unless set, and never of a live stream. */
  index?: boolean;
  /** Frames that are lost, or not to be trusted. */
  onDamage?: (damage: DamageInfo) => void;
  /** Materials, pictures and what else goes along; still packed where the stream packs them. */
  onData?: (data: FreeFormData) => void;
}

/** How far a stream has been fetched. */
export interface StreamProgress {
  /** Of the whole stream; undefined until it is known. */
  bytes: number | undefined;
  /** That are kept. */
  received: number;
  /** Of these bytes, the share that makes the first picture certain, 0 to 1; undefined without an index. */
  firstFrames: number | undefined;
  /** Frames whose bytes are all there, as [first, end) in order; empty without an index. */
  frames: [number, number][];
  bytesPerSecond: number | undefined;
  /** Of a ladder: which of its streams plays, 0 the best. */
  stream?: number;
}

/** What a step of a stream came to: a new mesh is told before its first frame. */
export type StreamEvent = "mesh" | "frame" | "end";

/** Connections that are cut in a row, with no byte between them, before the stream gives up. */
const kMostCuts = 3;
/** Milliseconds before the second connection; twice as long before the next. */
const kPatience = 200;

/**
 * A stream that is decoded while it arrives: `next` fetches and decodes until there is a frame, which is then read
 * through `decoder`. Bytes are fetched as frames are asked for, so a slow consumer slows the connection.
 */
export class TvgStream {
  private cuts = 0;
  /** In the stream, of the next byte to push. */
  private position = 0;
  private ended = false;
  /** Counts seeks: bytes that were asked for before one are not pushed after it. */
  private turn = 0;
  private turnOfEvent = 0;
  private table: FrameTable | undefined;

  private constructor(
    /** For frames, meshes and attributes; do not push, poll or seek by it. */
    readonly decoder: Decoder,
    private readonly source: ByteSource,
    private readonly options: StreamOptions,
  ) {}

  /** Opens a stream and reads its head, and its index where there is one. */
  static async open(from: StreamSource, options: StreamOptions = {}): Promise<TvgStream> {
    const module = options.module ?? (await TvgModule.load());
    options.signal?.throwIfAborted();
    const stream = new TvgStream(new Decoder(module, options.limits), await openSource(from, options), options);
    try {
      await stream.readHead();
      if (options.index !== false) await stream.readIndex();
    } catch (error) {
      stream.dispose();
      throw error;
    }
    return stream;
  }

  /** Frames of the whole stream; undefined where there is no index. */
  get frameCount(): number | undefined {
    return this.decoder.stream().frameCount;
  }

  /** Frames per second; 30 where the stream does not say. */
  get frameRate(): number {
    const [count, seconds] = (this.decoder.metadata().get("fps") ?? "").split("/").map(Number);
    const rate = (count ?? NaN) / (seconds ?? 1);
    return rate > 0 && Number.isFinite(rate) ? rate : 30;
  }

  /** The number of the frame that `next` came to. */
  get frameNumber(): number {
    return this.decoder.frame().number;
  }

  /** Whether what `next` came to is still there: a seek may come before its promise is heard of. */
  get isAtHand(): boolean {
    return this.turnOfEvent === this.turn;
  }

  /** The next mesh or frame. After "end" only `seek` goes on. */
  async next(): Promise<StreamEvent> {
    for (;;) {
      const event = this.decoder.poll();
      this.turnOfEvent = this.turn;
      switch (event) {
        case "need-bytes":
          await this.feed();
          break;
        case "mesh":
          return "mesh";
        case "frame":
          return "frame";
        case "damage":
          this.options.onDamage?.(this.decoder.damage());
          break;
        case "data":
          this.options.onData?.(this.decoder.data());
          break;
        case "end":
          return "end";
        case "error":
          throw this.decoder.error();
        default:
          break;
      }
    }
  }

  /** The next frame that `next` comes to is this one, or the first good one after it; also while `next` waits. */
  seek(frame: number): void {
    ++this.turn;
    this.position = this.decoder.seek(frame);
    this.source.goTo(this.position);
    this.ended = false;
  }

  /** Fetches the index, where there is one and the server has ranges; seeks go anywhere at once from then on. */
  async readIndex(): Promise<boolean> {
    const { size } = this.source;
    if (this.options.live || size === undefined || size < kTailBytes) return false;
    const tail = await this.source.readAt(size - kTailBytes, kTailBytes);
    const place = tail && this.decoder.locateIndex(tail, size);
    const index = place && (await this.source.readAt(place.offset, place.bytes));
    if (!index) return false;
    try {
      this.decoder.loadIndex(index);
    } catch (error) {
      // A broken index keeps nobody from playing: the stream says so itself when it comes to it.
      if (!(error instanceof TvgError)) throw error;
      return false;
    }
    this.table = new FrameTable(index, place.offset);
    return true;
  }

  /** What has been fetched so far. */
  progress(): StreamProgress {
    const { ranges, bytesPerSecond } = this.source.arrival();
    const received = ranges.reduce((sum, [from, to]) => sum + to - from, 0);
    const needed = this.table?.firstBytes;
    return {
      bytes: this.source.size,
      received,
      firstFrames: needed === undefined ? undefined : Math.min(1, received / needed),
      frames: this.table?.framesOf(ranges) ?? [],
      bytesPerSecond,
    };
  }

  /** Nothing more is fetched ahead until frames are asked for again. */
  rest(): void {
    this.source.rest();
  }

  /** Ends requests and gives back what the decoder holds. */
  dispose(): void {
    this.source.close();
    this.decoder.dispose();
  }

  private async readHead(): Promise<void> {
    for (;;) {
      const event = this.decoder.poll();
      if (event === "head") break;
      if (event === "error") throw this.decoder.error();
      if (event === "end") throw new TvgError("truncated", "the stream has no head");
      if (event === "need-bytes") await this.feed();
    }
  }

  private async feed(): Promise<void> {
    const passed = this.decoder.skip();
    if (passed > 0) {
      this.source.goTo((this.position += passed));
      // At the end of a chunk there may be more to pass.
      return;
    }
    const { turn } = this;
    const bytes = await this.readAgain();
    if (turn !== this.turn) {
      this.source.goTo(this.position);
    } else if (bytes !== undefined) {
      this.position += bytes.length;
      this.decoder.push(bytes);
    } else if (!this.ended) {
      this.ended = true;
      this.decoder.finish();
    }
  }

  /** Goes on where a connection was cut. */
  private async readAgain(): Promise<Uint8Array | undefined> {
    for (;;) {
      try {
        const bytes = await this.source.read();
        this.cuts = 0;
        return bytes;
      } catch (error) {
        if (!(error instanceof ConnectionError) || this.options.live || ++this.cuts >= kMostCuts) throw error;
        await new Promise((resolve) => setTimeout(resolve, this.cuts * kPatience));
        this.source.goTo(this.position);
      }
    }
  }
}
