import { TvgError } from "./errors.js";

/** The functions of tvg.h as the module exports them: pointers are numbers, 64-bit integers BigInts. */
export interface TvgExports {
  readonly memory: WebAssembly.Memory;
  _initialize?(): void;
  malloc(size: number): number;
  free(pointer: number): void;
  tvg_version(): number;
  tvg_limits_init(limits: number): number;
  tvg_decoder_create(limits: number): number;
  tvg_decoder_destroy(decoder: number): void;
  tvg_decoder_push(decoder: number, bytes: number, size: number): number;
  tvg_decoder_finish(decoder: number): number;
  tvg_decoder_poll(decoder: number): number;
  tvg_decoder_get_stream(decoder: number, info: number): number;
  tvg_decoder_metadata(decoder: number, key: number): number;
  tvg_decoder_metadata_key(decoder: number, index: number): number;
  tvg_decoder_get_mesh(decoder: number, info: number): number;
  tvg_decoder_get_gop(decoder: number, info: number): number;
  tvg_decoder_copy_flags(decoder: number, flags: number, size: number): number;
  tvg_decoder_get_frame(decoder: number, info: number): number;
  tvg_decoder_copy_positions(decoder: number, to: number, size: number, stride: number): number;
  tvg_decoder_compute_normals(decoder: number, to: number, size: number, stride: number): number;
  tvg_decoder_get_damage(decoder: number, info: number): number;
  tvg_locate_index(tail: number, size: number, streamBytes: bigint, offset: number, bytes: number): number;
  tvg_decoder_load_index(decoder: number, bytes: number, size: number): number;
  tvg_decoder_seek(decoder: number, frame: bigint, offset: number): number;
  tvg_decoder_skip(decoder: number): bigint;
  tvg_decoder_use_components(decoder: number, most: number): number;
  tvg_decoder_use_lod(decoder: number, lod: number): number;
  tvg_decoder_error_text(decoder: number): number;
  tvg_decoder_error_code(decoder: number): number;
  tvg_decoder_get_properties(decoder: number, info: number): number;
  tvg_decoder_get_attribute(decoder: number, attribute: number, info: number): number;
  tvg_decoder_copy_attribute(decoder: number, attribute: number, to: number, size: number, stride: number): number;
  tvg_decoder_copy_corners(decoder: number, attribute: number, corners: number, count: number): number;
  tvg_decoder_get_part(decoder: number, part: number, info: number): number;
  tvg_decoder_copy_face_parts(decoder: number, parts: number, count: number): number;
  tvg_decoder_get_view(decoder: number, view: number): number;
  tvg_decoder_get_view_range(decoder: number, part: number, range: number): number;
  tvg_decoder_copy_view_values(decoder: number, attribute: number, values: number, count: number): number;
  tvg_decoder_copy_view_positions(decoder: number, to: number, size: number, stride: number): number;
  tvg_decoder_compute_view_normals(decoder: number, to: number, size: number, stride: number): number;
  tvg_decoder_copy_view_attribute(
    decoder: number,
    attribute: number,
    to: number,
    size: number,
    stride: number,
  ): number;
  tvg_decoder_get_basis(decoder: number, info: number): number;
  tvg_decoder_copy_planes(decoder: number, group: number, to: number, count: number): number;
  tvg_decoder_copy_short_planes(decoder: number, group: number, to: number, count: number): number;
  tvg_decoder_copy_rows(decoder: number, to: number, count: number): number;
  tvg_decoder_get_data(decoder: number, info: number): number;
  tvg_decoder_copy_data(decoder: number, to: number, size: number): number;
}

/** Where tvg.wasm is, its bytes, or the module compiled from them. */
export type ModuleSource = string | URL | BufferSource | Response | WebAssembly.Module;

/** The decoder's code, compiled: to be instantiated once for each worker. It may be sent to workers. */
export async function compileModule(source: ModuleSource = defaultModuleUrl()): Promise<WebAssembly.Module> {
  if (source instanceof WebAssembly.Module) return source;
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return WebAssembly.compile(source);
  if (typeof Response !== "undefined" && source instanceof Response) return compileResponse(source);
  const url = source instanceof URL ? source : new URL(source as string, baseUrl());
  if (url.protocol === "file:") return WebAssembly.compile((await readFile(url)) as BufferSource);
  let response: Response;
  try {
    response = await fetch(url.href, { credentials: "same-origin" });
  } catch (error) {
    throw new TvgError("io", `${url.href} could not be fetched: ${(error as Error).message}`);
  }
  return compileResponse(response);
}

/** An instance of the decoder's code with memory of its own, which grows as streams need it. */
export class TvgModule {
  private constructor(
    /** For who wants to call tvg.h directly. */
    readonly exports: TvgExports,
  ) {}

  /** Compiles and instantiates; without an argument the tvg.wasm that lies beside this file. */
  static async load(source?: ModuleSource): Promise<TvgModule> {
    const compiled = await compileModule(source);
    // All that the module asks for: to be told of growth, which views here do not outlive, and an end on abort().
    const instance = await WebAssembly.instantiate(compiled, {
      env: { emscripten_notify_memory_growth: () => undefined },
      wasi_snapshot_preview1: {
        proc_exit: (status: number) => {
          throw new TvgError("out-of-memory", `the decoder gave up (${status}): there is no memory left`);
        },
      },
    });
    const exports = instance.exports as unknown as TvgExports;
    exports._initialize?.();
    return new TvgModule(exports);
  }

  /** The library's version, "0.2.0". */
  get version(): string {
    const version = this.exports.tvg_version();
    return `${version >>> 16}.${(version >>> 8) & 255}.${version & 255}`;
  }

  /** Bytes of memory that the instance holds. It never gives any back: who needs less makes a new one. */
  get memoryBytes(): number {
    return this.exports.memory.buffer.byteLength;
  }
}

function defaultModuleUrl(): URL {
  return new URL("./tvg.wasm", import.meta.url);
}

function baseUrl(): string {
  return typeof document !== "undefined" ? document.baseURI : import.meta.url;
}

async function compileResponse(response: Response): Promise<WebAssembly.Module> {
  if (!response.ok) {
    throw new TvgError("io", `${response.url}: the server answers ${response.status} ${response.statusText}`);
  }
  const type = response.headers.get("content-type") ?? "";
  // Servers that do not know .wasm name another type, which streaming compilation refuses.
  if (type.startsWith("application/wasm") && typeof WebAssembly.compileStreaming === "function") {
    return WebAssembly.compileStreaming(response);
  }
  return WebAssembly.compile(await response.arrayBuffer());
}

/** In Node. The name is put together so that bundlers for pages do not look for it. */
async function readFile(url: URL): Promise<Uint8Array> {
  const name = ["node", "fs/promises"].join(":");
  const files = (await import(name)) as { readFile(from: URL): Promise<Uint8Array> };
  try {
    return await files.readFile(url);
  } catch (error) {
    throw new TvgError("io", `${url.href} cannot be read: ${(error as Error).message}`);
  }
}
