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

/** The planes of a period of frames in mode "basis", ready to be a texture array. */
export interface FeedPlanes {
  components: number;
  /** Vertices of the mesh, not of its view. */
  vertexCount: number;
  /** Texels: vertex v is in column v % width of row v / width. */
  width: number;
  height: number;
  /** Of four planes each. */
  layers: number;
  /** [layer][row][column][4]. */
  coefficients: Int16Array | Float32Array;
  /** [component]: no coefficient is larger in size. */
  most: Float32Array;
  /** The first frame that came with them, whole: [1 + component][xyz], and as FeedFrame has it. */
  rows: Float32Array;
  positions: Float32Array;
  normals?: Float32Array;
}

/** What the planes of a period may take for a GPU to have them; others come as positions. */
export interface GpuLimits {
  /** Texels, each way. */
  textureSize: number;
  layers: number;
  components: number;
}

export interface FeedFrame {
  /** How many seeks came before it, and how often the stream had been played through since the last. */
  turn: number;
  lap: number;
  number: number;
  /** The first frame of its group. */
  gop: number;
  /** [render vertex][xyz]; empty where `rows` are there in its place. */
  positions: Float32Array;
  /** What the planes are multiplied by, where a GPU makes the frame: [1 + component][xyz]. */
  rows?: Float32Array;
  /** With rows; the same object through a period. */
  planes?: FeedPlanes;
  /** Unit normals where the mesh stores none, with positions. */
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
  | { type: "gpu"; id: number; limits: GpuLimits | undefined }
  | { type: "close"; id: number };

export type FeedAnswer =
  | { type: "head"; id: number; info: StreamInfo; frameRate: number; metadata: [string, string][] }
  | { type: "length"; id: number; frameCount: number }
  | { type: "progress"; id: number; progress: StreamProgress }
  | { type: "data"; id: number; data: FreeFormData }
  | { type: "mesh"; id: number; mesh: FeedMesh }
  | { type: "planes"; id: number; planes: FeedPlanes }
  | { type: "frame"; id: number; frame: FeedFrame }
  | { type: "damage"; id: number; damage: DamageInfo }
  | { type: "end"; id: number; turn: number; frameCount: number }
  | { type: "error"; id: number; code: TvgErrorCode; message: string };
