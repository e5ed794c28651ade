import { errorCodeName, TvgError } from "./errors.js";
import { writeLimits } from "./limits.js";
import type { TvgModule } from "./module.js";
import * as layout from "./structures.js";
import { Structure, textAt } from "./structures.js";
import type { DecoderLimits } from "./types.js";

/** A decoder's place in the module's memory, and how its functions are called. */
export class DecoderCalls {
  protected handle: number;
  /** Room for one structure and for what goes in and out, in the module's memory. */
  protected readonly structure: number;
  private scratch = 0;
  private scratchBytes = 0;

  constructor(
    readonly module: TvgModule,
    limits: DecoderLimits = {},
  ) {
    this.structure = module.exports.malloc(layout.kLargestStructureBytes);
    if (this.structure === 0) throw outOfMemory();
    const { exports } = module;
    this.at(layout.kLimitsBytes);
    exports.tvg_limits_init(this.structure);
    writeLimits(new Structure(module, this.structure, layout.kLimitsBytes), limits);
    this.handle = exports.tvg_decoder_create(this.structure);
    if (this.handle === 0) {
      exports.free(this.structure);
      throw outOfMemory();
    }
  }

  dispose(): void {
    if (this.handle === 0) return;
    this.module.exports.tvg_decoder_destroy(this.handle);
    this.module.exports.free(this.structure);
    this.module.exports.free(this.scratch);
    this.handle = this.scratch = this.scratchBytes = 0;
  }

  protected alive(): number {
    if (this.handle === 0) throw new TvgError("wrong-state", "the decoder was disposed of");
    return this.handle;
  }

  protected check(code: number): void {
    if (code === 0) return;
    const name = errorCodeName(code);
    const { exports } = this.module;
    const told = errorCodeName(exports.tvg_decoder_error_code(this.handle)) === name;
    const text = told ? textAt(this.module, exports.tvg_decoder_error_text(this.handle)) : undefined;
    throw new TvgError(name, text || `the decoder answers ${name}`);
  }

  protected at(bytes: number): Structure {
    return new Structure(this.module, this.structure, bytes).setSize();
  }

  protected get(bytes: number, fill: (decoder: number, at: number) => number): Structure {
    this.at(bytes);
    this.check(fill(this.alive(), this.structure));
    return new Structure(this.module, this.structure, bytes);
  }

  /** At least so many bytes of the module's memory, until the next call. */
  protected room(bytes: number): number {
    if (bytes <= this.scratchBytes) return this.scratch;
    const { exports } = this.module;
    exports.free(this.scratch);
    this.scratch = exports.malloc(bytes);
    this.scratchBytes = this.scratch === 0 ? 0 : bytes;
    if (this.scratch === 0) throw outOfMemory();
    return this.scratch;
  }

  protected bytesAt(pointer: number, count: number): Uint8Array {
    return new Uint8Array(this.module.exports.memory.buffer, pointer, count);
  }

  protected numbersAt(pointer: number, count: number): Uint32Array {
    return new Uint32Array(this.module.exports.memory.buffer, pointer, count).slice();
  }

  protected copyFloats(to: Float32Array, stride: number, copy: (at: number, size: number) => number): void {
    if (to.byteLength % stride !== 0) {
      throw new TvgError("invalid-argument", `${to.length} numbers are no whole count of values`);
    }
    const from = this.room(to.byteLength);
    this.check(copy(from, to.byteLength));
    to.set(new Float32Array(this.module.exports.memory.buffer, from, to.length));
  }

  protected copyNumbers(to: Uint32Array, copy: (at: number, count: number) => number): void {
    const from = this.room(to.byteLength);
    this.check(copy(from, to.length));
    to.set(new Uint32Array(this.module.exports.memory.buffer, from, to.length));
  }
}

function outOfMemory(): TvgError {
  return new TvgError("out-of-memory", "there is no memory for a decoder");
}
