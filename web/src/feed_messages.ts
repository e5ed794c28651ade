import type { StreamSource } from "./byte_source.js";
import type { TvgErrorCode } from "./errors.js";
import type { StreamProgress } from "./stream.js";
import type { DamageInfo, DecoderLimits, FreeFormData, PartInfo, StreamInfo, View } from "./types.js";

/** What a feed is told of the mesh of the frames that follow, ready to be drawn. */
export interface FeedMesh extends View {
  parts: PartInfo[];
  attributes: FeedAttribute[];
}

export interface FeedAttribute {
  kind: "texcoord" | "normal" | "colour" | "generic";
  name: string;
  components: number;
  /** Each frame has values of its own. */
  animated: boolean;
  /** [render vertex][component]; zeros where they are animated. */
  values: Float32Array;
}

export interface FeedFrame {
  /** How many seeks came before it, and how often the stream had been played through since the last. */
  turn: number;
  lap: number;
  number: number;
  /** The first frame of its group. */
  gop: number;
  /** [render vertex][xyz]. */
  positions: Float32Array;
  /** Unit normals where the mesh stores none. */
  normals?: Float32Array;
  /** Of the animated attributes in their order, as FeedAttribute has them. */
  values?: Float32Array[];
  /** Importance of each render vertex, 0 or 1: where it was asked for, with the first frame of each group. */
  flags?: Uint8Array;
}

export type FeedRequest =
  | {
      type: "open";
      id: number;
      source: StreamSource;
      code: WebAssembly.Module;
      limits?: DecoderLimits;
      headers?: Record<string, string>;
      live?: boolean;
      cacheBytes?: number;
    }
  | { type: "seek"; id: number; frame: number; turn: number }
  | { type: "take"; id: number; frames: number }
  | { type: "loop"; id: number; on: boolean }
  | { type: "flags"; id: number; on: boolean }
  | { type: "close"; id: number };

export type FeedAnswer =
  | { type: "head"; id: number; info: StreamInfo; frameRate: number; metadata: [string, string][] }
  | { type: "length"; id: number; frameCount: number }
  | { type: "progress"; id: number; progress: StreamProgress }
  | { type: "data"; id: number; data: FreeFormData }
  | { type: "mesh"; id: number; mesh: FeedMesh }
  | { type: "frame"; id: number; frame: FeedFrame }
  | { type: "damage"; id: number; damage: DamageInfo }
  | { type: "end"; id: number; turn: number; frameCount: number }
  | { type: "error"; id: number; code: TvgErrorCode; message: string };
