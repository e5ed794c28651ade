import * as THREE from "three";
import type { StreamSource } from "../byte_source.js";
import { asTvgError } from "../errors.js";
import { type FeedHost, LocalHost, WorkerHost } from "../feed.js";
import { compileModule, type ModuleSource } from "../module.js";
import { type PlayerOptions, TvgPlayer } from "../player.js";
import type { DecoderLimits } from "../types.js";
import { TVGMesh } from "./tvg_mesh.js";

/** Loads streams as meshes that play, decoded in workers; in the shape of DRACOLoader. */
export class TVGLoader extends THREE.Loader<TVGMesh> {
  private decoderPath = "";
  private decoder: Promise<WebAssembly.Module> | undefined;
  private workerLimit = 4;
  private limits: DecoderLimits | undefined;
  private makeWorker: (() => Worker) | undefined;
  private options: Omit<PlayerOptions, "host" | "wasm" | "limits" | "headers"> = {};
  private readonly hosts: FeedHost[] = [];
  private renderer: unknown;

  /** The folder of tvg.wasm; beside the package's script unless it is set. */
  setDecoderPath(path: string): this {
    this.decoderPath = path;
    this.decoder = undefined;
    return this;
  }
  /** The decoder itself, where it has no address. */
  setDecoder(wasm: ModuleSource): this {
    this.decoder = compileModule(wasm);
    return this;
  }
  /** Workers at most; streams beyond share them. 0 decodes on the calling thread. */
  setWorkerLimit(limit: number): this {
    this.workerLimit = limit;
    return this;
  }
  /** How workers are made, where a bundler wants it in its own way. */
  setWorker(makeWorker: () => Worker): this {
    this.makeWorker = makeWorker;
    return this;
  }
  setLimits(limits: DecoderLimits): this {
    this.limits = limits;
    return this;
  }
  /** What players of streams loaded from now on are made with. */
  setPlayerOptions(options: Omit<PlayerOptions, "host" | "wasm" | "limits" | "headers">): this {
    this.options = options;
    return this;
  }

  /** What draws meshes loaded from now on: where it can, its GPU makes their frames (TVGMesh.useGpu). */
  detectSupport(renderer: unknown): this {
    this.renderer = renderer;
    return this;
  }

  /** Fetches and compiles the decoder before a stream needs it. */
  preload(): this {
    this.code().catch(() => undefined);
    return this;
  }

  /** Gives the mesh once its first frame and its pictures are there; the rest arrives while it plays. */
  override load(
    url: string,
    onLoad: (mesh: TVGMesh) => void,
    onProgress?: (event: ProgressEvent) => void,
    onError?: (error: unknown) => void,
  ): void {
    const address = this.manager.resolveURL(this.path + url);
    this.manager.itemStart(address);
    this.open(address, onProgress)
      .then(onLoad)
      .catch((error) => {
        this.manager.itemError(address);
        if (onError) onError(error);
        else console.error(error);
      })
      .finally(() => this.manager.itemEnd(address));
  }

  /** As load, of a stream that is in memory. */
  parse(bytes: ArrayBuffer, onLoad: (mesh: TVGMesh) => void, onError?: (error: unknown) => void): void {
    this.open(bytes).then(onLoad, onError);
  }

  /** Ends all workers, and with them the streams that play. */
  dispose(): this {
    for (const host of this.hosts.splice(0)) host.dispose();
    return this;
  }

  private async open(source: StreamSource, onProgress?: (event: ProgressEvent) => void): Promise<TVGMesh> {
    const wasm = await this.code();
    const host = this.host();
    const player = new TvgPlayer(source, {
      ...this.options,
      host,
      wasm,
      headers: this.requestHeader,
      ...(this.limits && { limits: this.limits }),
    });
    const mesh = new TVGMesh(player);
    if (this.renderer) mesh.useGpu(this.renderer);
    const tell = (): void => onProgress?.(progressEvent(player));
    player.addEventListener("progress", tell);
    try {
      await new Promise<void>((resolve, reject) => {
        player.addEventListener("canplay", () => resolve(), { once: true });
        player.addEventListener("error", () => reject(player.error), { once: true });
      });
      await mesh.ready;
      return mesh;
    } catch (error) {
      mesh.dispose();
      if (host.isBroken) this.hosts.splice(this.hosts.indexOf(host), 1);
      throw error;
    } finally {
      player.removeEventListener("progress", tell);
    }
  }

  private code(): Promise<WebAssembly.Module> {
    this.decoder ??= compileModule(this.decoderPath === "" ? undefined : `${this.decoderPath}tvg.wasm`);
    return this.decoder;
  }

  /** The one with least to do, or another while there may be more. */
  private host(): FeedHost {
    const idle = [...this.hosts].sort((a, b) => a.load - b.load)[0];
    if (idle && (idle.load === 0 || this.hosts.length >= this.workerLimit)) return idle;
    const host = this.workerLimit > 0 ? new WorkerHost(this.newWorker()) : new LocalHost();
    this.hosts.push(host);
    return host;
  }

  private newWorker(): Worker {
    try {
      return this.makeWorker?.() ?? new Worker(new URL("../worker.js", import.meta.url), { type: "module" });
    } catch (error) {
      throw asTvgError(error);
    }
  }
}

function progressEvent({ progress }: TvgPlayer): ProgressEvent {
  const { received = 0, bytes } = progress ?? {};
  return new ProgressEvent("progress", { lengthComputable: bytes !== undefined, loaded: received, total: bytes ?? 0 });
}
