import type { TvgErrorCode } from "./errors.js";

/** What the decoder says next; "unknown" for an event of a later library, to be passed over. */
export type DecoderEvent =
  | "need-bytes"
  | "head"
  | "metadata"
  | "mesh"
  | "gop"
  | "frame"
  | "damage"
  | "end"
  | "error"
  | "data"
  | "unknown";

/** What a stream may ask for; one that declares more is refused before anything is allocated by it. */
export interface DecoderLimits {
  /** Of a mesh; 2^24 unless set. */
  vertices?: number;
  /** Of a mesh; 2^25 unless set. */
  faces?: number;
  /** 2^16 unless set. */
  framesPerGop?: number;
  /** Of one frame's packet; 2^29 unless set. */
  packetBytes?: number;
  /** Of the decoder; 4 GiB unless set. */
  memoryBytes?: number;
  /** Kept at once; 2^16 unless set. */
  meshes?: number;
  /** Of one mesh's chunk; 2^30 unless set. */
  meshBytes?: number;
  /** Of one chunk of planes that GOPs share; 2^30 unless set. */
  planBytes?: number;
  /** Of such a chunk; 2^14 unless set. */
  components?: number;
  /** Such chunks kept at once; 256 unless set. */
  plans?: number;
  /** That attributes, parts and polygons of a mesh take; 2^31 unless set. */
  propertyBytes?: number;
}

/** What the head of a stream says, and its index where that is known. */
export interface StreamInfo {
  /** "0.2". */
  format: string;
  /** No mesh has more. */
  vertices: number;
  /** No mesh has more. */
  faces: number;
  framesPerGop: number;
  /** The decoder needs no more. */
  memoryBytes: number;
  /** The decoder keeps no more at once. */
  meshes: number;
  /** Of the whole stream; left out without an index. */
  frameCount?: number;
}

export interface MeshInfo {
  vertexCount: number;
  faceCount: number;
  /** [face][corner], counter-clockwise; a copy. */
  faces: Uint32Array;
  /** Coarser meshes that the stream has of it. */
  lodCount: number;
  /** Which of them this is; 0: the whole mesh. */
  lod: number;
}

/** A group of frames that is decodable on its own, given its mesh. */
export interface GopInfo {
  /** Position in the stream. */
  firstFrame: number;
  /** Number of its first frame in the sequence that was encoded. */
  sourceFrame: number;
  frameCount: number;
  /** Those on the fine lattice. */
  importantVertices: number;
  /** Edge of a cell, in the mesh's units; an important coordinate is off by half of it at most (mode elp). */
  fineStep: number;
  /** The same of other vertices. */
  coarseStep: number;
  mode: "elp" | "basis" | "lossless" | "unknown";
  /** Of the basis that the GOP shares with others; 0 in other modes. */
  components: number;
}

/** The planes that frames of mode "basis" are sums of: one whole number for each vertex each. */
export interface BasisInfo {
  /** Those of the same number are the same, for this decoder. */
  number: number;
  vertexCount: number;
  /** Planes, as many as are decoded. */
  components: number;
  /** No coefficient is larger in size; at most 2^24. */
  most: number;
}

export interface FrameInfo {
  /** Position in the stream, counted from 0; lost frames count. */
  number: number;
  /** What the frame takes in the stream. */
  packetBytes: number;
}

/** Frames that are missing or, with "digest-mismatch" and "malformed", not to be trusted. */
export interface DamageInfo {
  firstFrame: number;
  /** 0 where no frame is lost, or nobody can know how many. */
  frameCount: number;
  code: TvgErrorCode;
  /** One line. */
  message: string;
  /** In the stream, where it is known. */
  byteOffset?: number;
}

export interface AttributeInfo {
  /** Its place among the mesh's attributes. */
  index: number;
  /** May be "", and need not be unique. */
  name: string;
  kind: "texcoord" | "normal" | "colour" | "generic";
  /** What has a value each; corners of several faces may share one. */
  domain: "vertex" | "corner" | "part";
  /** Numbers of a value, 1 to 4. */
  components: number;
  /** Of each number; 32: exact. */
  bits: number;
  /** Each frame has values of its own. */
  animated: boolean;
  valueCount: number;
}

/** "" where there is none. */
export interface PartInfo {
  object: string;
  group: string;
  material: string;
}

/** A vertex whose corners differ in an attribute becomes several; faces are sorted by their part. */
export interface View {
  vertexCount: number;
  /** Three to a face. */
  indices: Uint32Array;
  /** Which vertex of the mesh each is. */
  sourceVertices: Uint32Array;
  /** Where the faces of each part are in `indices`; one range where there are no parts. */
  ranges: { firstIndex: number; indexCount: number }[];
}

/** What goes along with a stream: "materials", "image/NAME" and the like. */
export interface FreeFormData {
  name: string;
  /** Once decoded. */
  size: number;
  encoding: "stored" | "zstd" | "unknown";
  /** As they are encoded. */
  bytes: Uint8Array;
}
