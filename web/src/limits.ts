import type { Structure } from "./structures.js";
import type { DecoderLimits } from "./types.js";

const kLimitPlaces = [
  ["vertices", 4],
  ["faces", 8],
  ["framesPerGop", 12],
  ["packetBytes", 16],
  ["meshes", 32],
  ["meshBytes", 36],
  ["planBytes", 40],
  ["components", 44],
  ["plans", 48],
  ["propertyBytes", 52],
] as const;

/** What is given, into a tvg_limits. */
export function writeLimits(structure: Structure, limits: DecoderLimits): void {
  for (const [name, at] of kLimitPlaces) {
    const value = limits[name];
    if (value !== undefined) structure.setU32(at, Math.min(Math.max(0, Math.floor(value)), 0xffffffff));
  }
  if (limits.memoryBytes !== undefined) {
    structure.setU64(24, BigInt(Math.max(0, Math.floor(limits.memoryBytes))));
  }
}
