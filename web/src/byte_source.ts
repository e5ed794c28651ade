import { HttpSource } from "./http_source.js";
import type { Throughput } from "./throughput.js";

/** What a stream is read from: a URL, or bytes that are in memory already. */
export type StreamSource = string | URL | Uint8Array | ArrayBuffer | Blob;

/** How a URL is fetched. */
export interface FetchOptions {
  /** Ends every request, and rejects what waits for one with the signal's reason. */
  signal?: AbortSignal;
  headers?: Record<string, string>;
  /** In place of the global `fetch`. */
  fetch?: typeof fetch;
  /** Bytes that are kept for when they are asked for again, as by loops; 64 MiB unless set. */
  cacheBytes?: number;
  /** Bytes that are fetched ahead of those asked for; 16 MiB unless set, and never more than half of what is kept. */
  aheadBytes?: number;
  /** The answer never ends: it is read once, as it comes, and a connection that is cut is not taken up again. */
  live?: boolean;
  /** What measures the line, where several streams share one. */
  throughput?: Throughput;
}

/** What of a stream has arrived. */
export interface Arrival {
  /** Bytes, as [from, to) in order. */
  ranges: [number, number][];
  /** How fast the line is; undefined until it is known, and of bytes in memory. */
  bytesPerSecond: number | undefined;
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
  arrival(): Arrival;
  /** No more is fetched ahead until the next read. */
  rest(): void;
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
  arrival(): Arrival {
    return { ranges: [[0, this.bytes.length]], bytesPerSecond: undefined };
  }
  rest(): void {}
  close(): void {
    this.offset = this.bytes.length;
  }
}
