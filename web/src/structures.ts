import type { TvgModule } from "./module.js";

// Structures of tvg.h as they lie in the module's memory: 32-bit pointers and sizes, 64-bit numbers on multiples of
// eight. Each begins with its size, which its user sets.

export const kLimitsBytes = 56;
export const kStreamBytes = 48;
export const kMeshBytes = 24;
export const kGopBytes = 56;
export const kFrameBytes = 32;
export const kDamageBytes = 48;
export const kPropertiesBytes = 16;
export const kAttributeBytes = 32;
export const kPartBytes = 16;
export const kViewBytes = 28;
export const kViewRangeBytes = 12;
export const kDataBytes = 32;
export const kBasisBytes = 32;
/** None of the above is larger. */
export const kLargestStructureBytes = 64;

const kUnknown = 0xffffffffffffffffn;
const text = new TextDecoder();

/** One structure at a place in memory; to be used before the next call into the module, which may move memory. */
export class Structure {
  private readonly view: DataView;

  constructor(module: TvgModule, pointer: number, bytes: number) {
    this.view = new DataView(module.exports.memory.buffer, pointer, bytes);
  }
  setSize(): this {
    this.view.setUint32(0, this.view.byteLength, true);
    return this;
  }
  u16(at: number): number {
    return this.view.getUint16(at, true);
  }
  u32(at: number): number {
    return this.view.getUint32(at, true);
  }
  setU32(at: number, value: number): void {
    this.view.setUint32(at, value, true);
  }
  setU64(at: number, value: bigint): void {
    this.view.setBigUint64(at, value, true);
  }
  f64(at: number): number {
    return this.view.getFloat64(at, true);
  }
  /** A 64-bit number, exact up to 2^53. */
  u64(at: number): number {
    return Number(this.view.getBigUint64(at, true));
  }
  /** The same, undefined for TVG_UNKNOWN. */
  known(at: number): number | undefined {
    const value = this.view.getBigUint64(at, true);
    return value === kUnknown ? undefined : Number(value);
  }
}

/** A text that ends with a zero byte; undefined for a null pointer. */
export function textAt(module: TvgModule, pointer: number): string | undefined {
  if (pointer === 0) return undefined;
  const bytes = new Uint8Array(module.exports.memory.buffer);
  return text.decode(bytes.slice(pointer, bytes.indexOf(0, pointer)));
}
