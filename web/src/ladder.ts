import { asTvgError, TvgError } from "./errors.js";
import { type StreamEvent, type StreamOptions, type StreamProgress, TvgStream } from "./stream.js";
import { Throughput } from "./throughput.js";

/** One of the streams of a ladder: the same frames in another quality. */
export interface LadderRung {
  /** Beside the manifest. */
  file: string;
  bits_per_second: number;
}

/** What `tvg ladder` writes: one animation in several streams, from the best to the least. */
export interface LadderManifest {
  frame_rate: number;
  frame_count: number;
  /** At multiples of so many frames another stream may go on. */
  period_frames: number;
  streams: LadderRung[];
}

/** What a choice of stream goes by. */
export interface Line {
  /** Undefined until it is known. */
  bytesPerSecond: number | undefined;
  /** Of frames that are there already. */
  bufferedSeconds: number;
  /** The stream that plays. */
  current: number;
}

/**
 * A stream is begun with when it takes no more of the line than the first, or the second while much is there already,
 * and kept as long as it takes no more than the third.
 */
const kShareToRise = 0.7;
const kShareToTry = 0.85;
const kShareToStay = 0.9;
/** Seconds that are to be there before a better stream is tried, and with which a slow line is waited out. */
const kEnoughToRise = 1;
const kEnoughToTry = 4;
const kEnoughToStay = 6;
/** Milliseconds of waiting for a frame after which a lesser stream goes on without waiting for the period's end. */
const kImpatience = 1000;
/** Seconds that are fetched ahead. */
const kAheadSeconds = 12;
const kLeastAheadBytes = 1 << 18;
/** Seconds that are to be there for a lesser stream to be waited for; with less it takes over at once. */
const kEnoughToPrepare = 1;
/** Frames between looks at the line. */
const kLook = 4;

/** Which of streams of these rates, the best first, the line is good for. */
export function pickStream(bitsPerSecond: number[], { bytesPerSecond, bufferedSeconds, current }: Line): number {
  // A stream that is too small to measure the line by is none too much for it.
  if (bytesPerSecond === undefined) return bufferedSeconds >= kEnoughToTry ? Math.max(0, current - 1) : current;
  const line = 8 * bytesPerSecond;
  const share = bufferedSeconds >= kEnoughToTry ? kShareToTry : kShareToRise;
  const found = bitsPerSecond.findIndex((rate) => rate <= share * line);
  const affordable = found < 0 ? bitsPerSecond.length - 1 : found;
  if (affordable < current) return bufferedSeconds >= kEnoughToRise ? affordable : current;
  const isTooMuch = bitsPerSecond[current]! > kShareToStay * line && bufferedSeconds < kEnoughToStay;
  return isTooMuch ? affordable : current;
}

/** What a manifest says, or an error that says what is wrong with it. */
export function parseLadder(json: unknown): LadderManifest {
  const ladder = json as Partial<LadderManifest> & { tvg_ladder?: unknown };
  const isPositive = (value: unknown): value is number => typeof value === "number" && value > 0 && Number.isFinite(value);
  const isRung = (rung: Partial<LadderRung> | null): boolean =>
    typeof rung?.file === "string" && isPositive(rung.bits_per_second);
  const isGood =
    ladder?.tvg_ladder === 1 &&
    [ladder.frame_rate, ladder.frame_count, ladder.period_frames].every(isPositive) &&
    Array.isArray(ladder.streams) &&
    ladder.streams.length > 0 &&
    ladder.streams.every(isRung);
  if (!isGood) throw new TvgError("malformed", "the manifest is none of a ladder of streams (tvg_ladder 1)");
  return ladder as LadderManifest;
}

/** A stream that is on its way to a frame, to go on from there. */
interface Candidate {
  index: number;
  stream: TvgStream | undefined;
  /** The frame that is at hand. */
  ready: number | undefined;
}

/** A stream in several qualities, which plays the one that the line is good for; to be used as a TvgStream. */
export class LadderStream {
  private candidate: Candidate | undefined;
  private frame = -1;
  /** Events of what is at hand in a stream that was switched to. */
  private held: StreamEvent[] = [];
  /** A stream that is to go on before the next border: what plays has come to its end. */
  private urgent: number | undefined;
  private disposed = false;

  private constructor(
    private readonly manifest: LadderManifest,
    private readonly base: string,
    private readonly options: StreamOptions,
    private now: TvgStream,
    private index: number,
  ) {}

  /** Fetches the manifest, and begins with the least stream: its first picture is there soonest. */
  static async open(url: string, given: StreamOptions): Promise<LadderStream> {
    const options = { throughput: new Throughput(), ...given };
    const manifest = await fetchManifest(url, options);
    const index = manifest.streams.length - 1;
    return new LadderStream(manifest, url, options, await openRung(manifest, url, index, options), index);
  }

  get decoder(): TvgStream["decoder"] {
    return this.now.decoder;
  }
  get frameCount(): number {
    return this.manifest.frame_count;
  }
  get frameRate(): number {
    return this.manifest.frame_rate;
  }
  get frameNumber(): number {
    return this.now.frameNumber;
  }
  get isAtHand(): boolean {
    return this.now.isAtHand;
  }
  /** Which of the manifest's streams plays. */
  get current(): number {
    return this.index;
  }

  async next(): Promise<StreamEvent> {
    this.switchWhereReady();
    const held = this.now.isAtHand ? this.held.shift() : undefined;
    if (held !== undefined) return this.came(held);
    this.held = [];
    if (this.urgent !== undefined) await this.goOnAtOnce(this.urgent);
    for (let step = this.now.next(); ; ) {
      const event = await orLate(step);
      if (event !== "late") return this.came(event);
      const lesser = this.pick().index;
      if (lesser <= this.index) continue;
      step.catch(() => undefined);
      await this.goOnAtOnce(lesser);
      step = this.now.next();
    }
  }

  seek(frame: number): void {
    this.held = [];
    this.frame = frame - 1;
    this.dropCandidate();
    this.now.seek(frame);
  }

  readIndex(): Promise<boolean> {
    return this.now.readIndex();
  }
  progress(): StreamProgress {
    return { ...this.now.progress(), stream: this.index };
  }
  rest(): void {
    this.now.rest();
  }
  dispose(): void {
    this.disposed = true;
    this.dropCandidate();
    this.now.dispose();
  }

  private came(event: StreamEvent): StreamEvent {
    if (event !== "frame" || !this.now.isAtHand) return event;
    this.frame = this.now.frameNumber;
    if (this.frame % kLook === 0) this.look();
    return event;
  }

  private look(): void {
    const { index: wanted, bufferedSeconds } = this.pick();
    this.urgent = wanted > this.index && bufferedSeconds < kEnoughToPrepare ? wanted : undefined;
    if (this.urgent !== undefined || wanted === this.candidate?.index) return;
    this.dropCandidate();
    if (wanted === this.index || this.nextBorder() === undefined) return;
    const candidate: Candidate = { index: wanted, stream: undefined, ready: undefined };
    this.candidate = candidate;
    this.prepare(candidate).catch(() => {
      // What cannot be had is not gone on with; the stream that plays tells its own errors.
      if (this.candidate === candidate) this.dropCandidate();
    });
  }

  private pick(): { index: number; bufferedSeconds: number } {
    const { bytesPerSecond, frames } = this.progress();
    const end = frames.find(([first, last]) => first <= this.frame && this.frame < last)?.[1] ?? this.frame;
    const bufferedSeconds = end >= this.frameCount ? Infinity : (end - this.frame) / this.frameRate;
    const rates = this.manifest.streams.map((rung) => rung.bits_per_second);
    const index = pickStream(rates, { bytesPerSecond, bufferedSeconds, current: this.index });
    return { index, bufferedSeconds };
  }

  /** The next frame at which another stream may go on. */
  private nextBorder(): number | undefined {
    const period = this.manifest.period_frames;
    const border = (Math.floor(this.frame / period) + 1) * period;
    return border < this.frameCount ? border : undefined;
  }

  /** Brings a stream to the next border, and to the one after it where that was passed meanwhile. */
  private async prepare(candidate: Candidate): Promise<void> {
    const stream = await openRung(this.manifest, this.base, candidate.index, this.options);
    if (this.candidate !== candidate) return stream.dispose();
    candidate.stream = stream;
    await stream.readIndex();
    for (let border = this.nextBorder(); border !== undefined; border = this.nextBorder()) {
      stream.seek(border);
      await untilFrame(stream);
      if (this.candidate !== candidate) return;
      if (border !== this.nextBorder() || stream.frameNumber !== border) continue;
      candidate.ready = border;
      stream.rest();
      return;
    }
  }

  private switchWhereReady(): void {
    const { candidate } = this;
    if (!candidate?.stream || candidate.ready === undefined || candidate.ready > this.frame + 1) return;
    this.candidate = undefined;
    if (candidate.ready !== this.frame + 1) return candidate.stream.dispose();
    this.now.dispose();
    this.now = candidate.stream;
    this.index = candidate.index;
    this.held = ["mesh", "frame"];
  }

  /** Another stream takes over with the next frame, wherever that is. */
  private async goOnAtOnce(index: number): Promise<void> {
    this.urgent = undefined;
    this.dropCandidate();
    this.now.rest();
    const stream = await openRung(this.manifest, this.base, index, this.options);
    if (this.disposed) return stream.dispose();
    this.now.dispose();
    this.now = stream;
    this.index = index;
    await stream.readIndex();
    // A seek may have come meanwhile.
    stream.seek(this.frame + 1);
  }

  private dropCandidate(): void {
    this.candidate?.stream?.dispose();
    this.candidate = undefined;
  }
}

async function fetchManifest(url: string, options: StreamOptions): Promise<LadderManifest> {
  const { signal, headers } = options;
  const get = options.fetch ?? fetch;
  try {
    const response = await get(url, { ...(signal && { signal }), ...(headers && { headers }) });
    if (!response.ok) throw new TvgError("io", `${url}: the server answers ${response.status} ${response.statusText}`);
    return parseLadder(await response.json());
  } catch (error) {
    signal?.throwIfAborted();
    throw asTvgError(error);
  }
}

function openRung(manifest: LadderManifest, base: string, index: number, options: StreamOptions): Promise<TvgStream> {
  const { file, bits_per_second: rate } = manifest.streams[index]!;
  const aheadBytes = Math.max(kLeastAheadBytes, (rate / 8) * kAheadSeconds);
  return TvgStream.open(new URL(file, base), { aheadBytes, ...options });
}

async function untilFrame(stream: TvgStream): Promise<void> {
  for (;;) {
    const event = await stream.next();
    if (event === "end") throw new TvgError("malformed", "a stream of the ladder is shorter than the manifest says");
    if (event === "frame" && stream.isAtHand) return;
  }
}

/** What a step comes to, or "late" where that takes too long. */
function orLate(step: Promise<StreamEvent>): Promise<StreamEvent | "late"> {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(() => resolve("late"), kImpatience);
    step.then(resolve, reject).finally(() => clearTimeout(timer));
  });
}
