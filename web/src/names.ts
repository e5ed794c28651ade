import type { DecoderEvent } from "./types.js";

// What the numbers of tvg.h are called here.
export const kEvents: readonly DecoderEvent[] = [
  "need-bytes",
  "head",
  "metadata",
  "mesh",
  "gop",
  "frame",
  "damage",
  "end",
  "error",
  "data",
];
export const kKinds = ["texcoord", "normal", "colour", "generic"] as const;
export const kDomains = ["vertex", "corner", "part"] as const;
export const kModes = ["elp", "basis", "lossless"] as const;

/** A stream's last bytes, by which its index is found. */
export const kTailBytes = 28;
