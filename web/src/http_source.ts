import { ByteCache } from "./byte_cache.js";
import type { Arrival, ByteSource, FetchOptions } from "./byte_source.js";
import { asTvgError, TvgError } from "./errors.js";
import { Throughput } from "./throughput.js";

/** A connection that could not be made or was cut: another one may go on. */
export class ConnectionError extends TvgError {}

const kCacheBytes = 1 << 26;
const kLeastCacheBytes = 1 << 23;
const kAheadBytes = 1 << 24;
/** What lies so little ahead is read over: another request would take longer. */
const kReadOnBytes = 1 << 16;
/** Given out in pieces, so that a reader is not busy for long with what was fetched before. */
const kPieceBytes = 1 << 16;

/** A stream that is fetched ahead of its reader, and kept as far as there is room. */
export class HttpSource implements ByteSource {
  size: number | undefined;
  private readonly cache: ByteCache;
  private readonly ahead: number;
  private readonly throughput: Throughput;
  private reader: ReadableStreamDefaultReader<Uint8Array> | undefined;
  private request: AbortController | undefined;
  /** Counts connections given up: what comes of an earlier one is nothing any more. */
  private connection = 0;
  /** Where the connection's next byte is, and where the next one wanted is. */
  private at = 0;
  private wanted = 0;
  /** Whether the server has ranges; undefined until it has told. */
  private ranges: boolean | undefined;
  private etag: string | undefined;
  private busy = false;
  private closed = false;
  private resting = false;
  private fault: unknown;
  private wake: (() => void) | undefined;

  constructor(
    private readonly url: string,
    private readonly options: FetchOptions,
  ) {
    const kept = Math.max(kLeastCacheBytes, options.live ? 0 : (options.cacheBytes ?? kCacheBytes));
    this.cache = new ByteCache(kept);
    if (options.live) this.ranges = false;
    this.throughput = options.throughput ?? new Throughput();
    this.ahead = Math.min(options.aheadBytes ?? kAheadBytes, kept / 2);
  }

  async read(): Promise<Uint8Array | undefined> {
    this.resting = false;
    for (;;) {
      this.options.signal?.throwIfAborted();
      const bytes = this.cache.at(this.wanted)?.subarray(0, kPieceBytes);
      if (bytes) this.wanted += bytes.length;
      if (!bytes && this.fault !== undefined) {
        const { fault } = this;
        this.fault = undefined;
        throw fault;
      }
      if (!bytes && this.closed) return undefined;
      if (!bytes && this.size !== undefined && this.wanted >= this.size) return undefined;
      void this.fetchAhead();
      if (bytes) return bytes;
      await new Promise<void>((resolve) => (this.wake = resolve));
    }
  }

  goTo(offset: number): void {
    this.wanted = offset;
    this.fault = undefined;
    // What is under way to another place is ended at once.
    if (this.busy && !this.canReach(this.cache.firstGap(offset))) this.disconnect();
  }

  async readAt(offset: number, bytes: number): Promise<Uint8Array | undefined> {
    const there = this.cache.at(offset);
    if (there && there.length >= bytes) return there.slice(0, bytes);
    if (this.ranges === false || bytes === 0) return undefined;
    const response = await this.fetch(`bytes=${offset}-${offset + bytes - 1}`, this.options.signal);
    if (response.status !== 206) {
      await response.body?.cancel();
      return undefined;
    }
    try {
      return new Uint8Array(await response.arrayBuffer());
    } catch (error) {
      throw this.connectionError(error);
    }
  }

  arrival(): Arrival {
    return { ranges: this.cache.ranges(), bytesPerSecond: this.throughput.bytesPerSecond };
  }

  rest(): void {
    this.resting = true;
    if (this.ranges) this.disconnect();
  }

  close(): void {
    this.closed = true;
    this.disconnect();
    this.wake?.();
  }

  /** Fetches what is not there yet from the reader on, until there is enough. */
  private async fetchAhead(): Promise<void> {
    if (this.busy || this.closed || this.fault !== undefined) return;
    this.busy = true;
    try {
      for (let gap = this.nextGap(); gap !== undefined; gap = this.nextGap()) await this.fetchPiece(gap);
    } catch (error) {
      this.fault = error;
    } finally {
      this.busy = false;
      this.throughput.pause();
      this.wake?.();
    }
  }

  /** The first byte to fetch; undefined where there is enough. */
  private nextGap(): number | undefined {
    const gap = this.cache.firstGap(this.wanted);
    const isDone = this.closed || (this.size !== undefined && gap >= this.size);
    const isEnough = gap - this.wanted >= (this.resting ? 1 : this.ahead);
    return isDone || isEnough ? undefined : gap;
  }

  private async fetchPiece(gap: number): Promise<void> {
    if (!this.canReach(gap)) this.disconnect();
    const { connection } = this;
    try {
      if (this.reader === undefined) await this.connect(gap);
      if (connection !== this.connection) return;
      const piece = await this.receive(this.reader!);
      if (connection !== this.connection) return;
      if (piece === undefined) return this.endOfBody();
      this.cache.add(this.at, piece, this.wanted);
      this.at += piece.length;
      this.wake?.();
    } catch (error) {
      // Of a connection that was given up there is nothing to tell.
      if (connection !== this.connection) return;
      this.disconnect();
      throw this.connectionError(error);
    }
  }

  private async receive(reader: ReadableStreamDefaultReader<Uint8Array>): Promise<Uint8Array | undefined> {
    let bytes = 0;
    this.throughput.wait();
    try {
      const { value } = await reader.read();
      bytes = value?.length ?? 0;
      return value;
    } finally {
      this.throughput.came(bytes);
    }
  }

  private canReach(offset: number): boolean {
    if (this.reader === undefined || offset < this.at) return false;
    return this.ranges === false || offset - this.at <= kReadOnBytes;
  }

  private disconnect(): void {
    ++this.connection;
    this.request?.abort();
    this.reader = this.request = undefined;
  }

  private async connect(gap: number): Promise<void> {
    if (this.options.live && this.at > 0) throw new TvgError("io", `${this.url}: the live stream broke off`);
    const { connection } = this;
    const request = (this.request = new AbortController());
    const { signal } = this.options;
    signal?.addEventListener("abort", () => request.abort(signal.reason), { once: true, signal: request.signal });
    const from = this.ranges === false ? 0 : gap;
    // Asked for a range from the first byte on, no server packs its answer: offsets in what is packed mean nothing.
    const response = await this.fetch(this.options.live ? undefined : `bytes=${from}-`, request.signal);
    if (connection !== this.connection) return;
    this.at = response.status === 206 ? from : 0;
    this.learn(response, gap);
    if (response.body === null) throw new TvgError("io", `${this.url}: the answer is empty`);
    this.reader = response.body.getReader() as ReadableStreamDefaultReader<Uint8Array>;
  }

  /** How long the stream is, whether it can be read from anywhere, and that it is still the same one. */
  private learn(response: Response, gap: number): void {
    const length = response.headers.get("content-length");
    const range = /\/(\d+)$/.exec(response.headers.get("content-range") ?? "");
    const encoded = response.headers.get("content-encoding") !== null;
    if (range) this.size = Number(range[1]);
    else if (length !== null && !encoded) this.size = Number(length);
    if (response.status === 206) this.ranges = true;
    else if (gap > 0) this.ranges = false;
    const etag = response.headers.get("etag") ?? undefined;
    if (this.etag !== undefined && etag !== undefined && etag !== this.etag) {
      throw new TvgError("io", `${this.url} was replaced while it was read; open it anew`);
    }
    this.etag = etag;
  }

  private async fetch(range: string | undefined, signal: AbortSignal | undefined): Promise<Response> {
    const headers = { ...this.options.headers, ...(range === undefined ? {} : { Range: range }) };
    const get = this.options.fetch ?? fetch;
    let response: Response;
    try {
      response = await get(this.url, { headers, ...(signal ? { signal } : {}) });
    } catch (error) {
      throw this.connectionError(error);
    }
    if (!response.ok) {
      await response.body?.cancel();
      throw new TvgError("io", `${this.url}: the server answers ${response.status} ${response.statusText}`);
    }
    return response;
  }

  /** Before the end that the server told, the connection was cut. */
  private endOfBody(): void {
    this.reader = undefined;
    if (this.size !== undefined && this.at < this.size) {
      throw new ConnectionError("io", `${this.url}: the connection ended after ${this.at} of ${this.size} bytes`);
    }
    this.size ??= this.at;
  }

  private connectionError(error: unknown): unknown {
    if (this.options.signal?.aborted) return this.options.signal.reason;
    if (error instanceof TvgError) return error;
    return new ConnectionError("io", `${this.url} could not be read: ${asTvgError(error).message}`);
  }
}
