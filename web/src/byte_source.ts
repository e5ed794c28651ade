import { asTvgError, TvgError } from "./errors.js";

/** What a stream is read from: a URL, or bytes that are in memory already. */
export type StreamSource = string | URL | Uint8Array | ArrayBuffer | Blob;

/** How a URL is fetched. */
export interface FetchOptions {
  /** Ends every request, and rejects what waits for one with the signal's reason. */
  signal?: AbortSignal;
  headers?: Record<string, string>;
  /** In place of the global `fetch`. */
  fetch?: typeof fetch;
}

/** Bytes of a stream in order, from any place on. */
export interface ByteSource {
  /** Of the whole stream, once it is known. */
  readonly size: number | undefined;
  /** The next bytes; undefined at the end. */
  read(): Promise<Uint8Array | undefined>;
  /** The next bytes read are those at `offset`. */
  goTo(offset: number): void;
  /** Some bytes from elsewhere, without moving; undefined where the server has no ranges. */
  readAt(offset: number, bytes: number): Promise<Uint8Array | undefined>;
  close(): void;
}

/** Opens nothing yet: the first read does. */
export async function openSource(source: StreamSource, options: FetchOptions = {}): Promise<ByteSource> {
  if (source instanceof Uint8Array) return new MemorySource(source);
  if (source instanceof ArrayBuffer) return new MemorySource(new Uint8Array(source));
  if (typeof Blob !== "undefined" && source instanceof Blob) {
    return new MemorySource(new Uint8Array(await source.arrayBuffer()));
  }
  return new HttpSource(source.toString(), options);
}

/** Given out in pieces, so that frames of a large stream come before all of it is decoded. */
const kPieceBytes = 1 << 16;
/** What lies so little ahead is read and thrown away: another request would take longer. */
const kReadOnBytes = 1 << 16;

class MemorySource implements ByteSource {
  private offset = 0;
  constructor(private readonly bytes: Uint8Array) {}
  get size(): number {
    return this.bytes.length;
  }
  async read(): Promise<Uint8Array | undefined> {
    if (this.offset >= this.bytes.length) return undefined;
    const piece = this.bytes.subarray(this.offset, this.offset + kPieceBytes);
    this.offset += piece.length;
    return piece;
  }
  goTo(offset: number): void {
    this.offset = offset;
  }
  async readAt(offset: number, bytes: number): Promise<Uint8Array | undefined> {
    return this.bytes.subarray(offset, offset + bytes);
  }
  close(): void {
    this.offset = this.bytes.length;
  }
}

class HttpSource implements ByteSource {
  size: number | undefined;
  private reader: ReadableStreamDefaultReader<Uint8Array> | undefined;
  private request: AbortController | undefined;
  /** Where the connection's next byte is, and where the next one wanted is. */
  private at = 0;
  private wanted = 0;
  /** Whether the server has ranges; undefined until it has told. */
  private ranges: boolean | undefined;
  private etag: string | undefined;

  constructor(
    private readonly url: string,
    private readonly options: FetchOptions,
  ) {}

  async read(): Promise<Uint8Array | undefined> {
    this.options.signal?.throwIfAborted();
    if (this.size !== undefined && this.wanted >= this.size) return undefined;
    if (this.reader === undefined || !this.isAhead()) await this.connect();
    for (;;) {
      const piece = await this.nextPiece();
      if (piece === undefined) return this.endOfBody();
      const start = this.at;
      this.at += piece.length;
      if (this.at <= this.wanted) continue;
      const useful = piece.subarray(Math.max(0, this.wanted - start));
      this.wanted = this.at;
      return useful;
    }
  }

  goTo(offset: number): void {
    this.wanted = offset;
  }

  async readAt(offset: number, bytes: number): Promise<Uint8Array | undefined> {
    if (this.ranges === false || bytes === 0) return undefined;
    const response = await this.fetch(`bytes=${offset}-${offset + bytes - 1}`, this.options.signal);
    if (response.status !== 206) {
      await response.body?.cancel();
      return undefined;
    }
    return new Uint8Array(await response.arrayBuffer());
  }

  close(): void {
    this.disconnect();
  }

  private isAhead(): boolean {
    return this.wanted >= this.at && (this.ranges === false || this.wanted - this.at <= kReadOnBytes);
  }

  private disconnect(): void {
    this.request?.abort();
    this.reader = this.request = undefined;
  }

  private async connect(): Promise<void> {
    this.disconnect();
    this.request = new AbortController();
    const { signal } = this.options;
    const request = this.request;
    signal?.addEventListener("abort", () => request.abort(signal.reason), { once: true, signal: request.signal });
    const from = this.ranges === false ? 0 : this.wanted;
    const response = await this.fetch(from > 0 ? `bytes=${from}-` : undefined, request.signal);
    this.at = response.status === 206 ? from : 0;
    this.learn(response);
    if (response.body === null) throw new TvgError("io", `${this.url}: the answer is empty`);
    this.reader = response.body.getReader() as ReadableStreamDefaultReader<Uint8Array>;
  }

  /** How long the stream is, whether it can be read from anywhere, and that it is still the same one. */
  private learn(response: Response): void {
    const length = response.headers.get("content-length");
    const range = /\/(\d+)$/.exec(response.headers.get("content-range") ?? "");
    const encoded = response.headers.get("content-encoding") !== null;
    if (range) this.size = Number(range[1]);
    else if (length !== null && !encoded) this.size = Number(length);
    if (response.status === 206) this.ranges = true;
    else if (this.wanted > 0) this.ranges = false;
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
      throw this.fault(error);
    }
    if (!response.ok) {
      await response.body?.cancel();
      throw new TvgError("io", `${this.url}: the server answers ${response.status} ${response.statusText}`);
    }
    return response;
  }

  private async nextPiece(): Promise<Uint8Array | undefined> {
    try {
      return (await this.reader!.read()).value;
    } catch (error) {
      this.disconnect();
      throw this.fault(error);
    }
  }

  /** Before the end that the server told, the connection was cut. */
  private endOfBody(): undefined {
    this.reader = undefined;
    if (this.size !== undefined && this.at < this.size) {
      throw new TvgError("io", `${this.url}: the connection ended after ${this.at} of ${this.size} bytes`);
    }
    this.size ??= this.at;
    return undefined;
  }

  private fault(error: unknown): unknown {
    if (this.options.signal?.aborted) return this.options.signal.reason;
    const told = asTvgError(error);
    return new TvgError("io", `${this.url} could not be read: ${told.message}`);
  }
}
