import { DecoderCalls } from "./decoder_calls.js";
import { errorCodeName, TvgError, type TvgErrorCode } from "./errors.js";
import type { TvgModule } from "./module.js";
import { kDomains, kEvents, kKinds, kModes } from "./names.js";
import * as layout from "./structures.js";
import { Structure, textAt } from "./structures.js";
import type {
  AttributeInfo,
  BasisInfo,
  DamageInfo,
  DecoderEvent,
  DecoderLimits,
  FreeFormData,
  FrameInfo,
  GopInfo,
  MeshInfo,
  PartInfo,
  StreamInfo,
  View,
} from "./types.js";

/**
 * The decoder of tvg.h: bytes go in as they arrive, events come out, frames are written into the caller's arrays. It
 * opens no connection; `TvgStream` does that. Every function throws `TvgError`; `dispose` gives the memory back.
 */
export class Decoder extends DecoderCalls {
  /** What `limits` leaves out is as in tvg.h. */
  constructor(module: TvgModule, limits: DecoderLimits = {}) {
    super(module, limits);
  }

  /** Gives back what the decoder holds; it must not be used any more. May be called again. */
  override dispose(): void {
    super.dispose();
  }

  /** Takes the next bytes of the stream; they are copied. */
  push(bytes: Uint8Array): void {
    const to = this.room(bytes.length);
    this.bytesAt(to, bytes.length).set(bytes);
    this.check(this.module.exports.tvg_decoder_push(this.alive(), to, bytes.length));
  }

  /** Says that no bytes follow. */
  finish(): void {
    this.check(this.module.exports.tvg_decoder_finish(this.alive()));
  }

  /** The next event. After "end" and "error" it stays the same. */
  poll(): DecoderEvent {
    return kEvents[this.module.exports.tvg_decoder_poll(this.alive())] ?? "unknown";
  }

  /** What went wrong last. */
  error(): TvgError {
    const { exports } = this.module;
    const code = errorCodeName(exports.tvg_decoder_error_code(this.alive()));
    return new TvgError(code, textAt(this.module, exports.tvg_decoder_error_text(this.handle)) ?? "");
  }

  /** From "head" on. */
  stream(): StreamInfo {
    const info = this.get(layout.kStreamBytes, this.module.exports.tvg_decoder_get_stream);
    const frameCount = info.known(32);
    return {
      format: `${info.u16(4)}.${info.u16(6)}`,
      vertices: info.u32(8),
      faces: info.u32(12),
      framesPerGop: info.u32(16),
      memoryBytes: info.u64(24),
      meshes: info.u32(40),
      ...(frameCount === undefined ? {} : { frameCount }),
    };
  }

  /** All of it, from "metadata" on; empty before. */
  metadata(): Map<string, string> {
    const { exports } = this.module;
    const entries = new Map<string, string>();
    for (let index = 0; ; ++index) {
      const key = exports.tvg_decoder_metadata_key(this.alive(), index);
      const name = textAt(this.module, key);
      if (name === undefined) return entries;
      entries.set(name, textAt(this.module, exports.tvg_decoder_metadata(this.handle, key)) ?? "");
    }
  }

  /** From "mesh" on. */
  mesh(): MeshInfo {
    const info = this.get(layout.kMeshBytes, this.module.exports.tvg_decoder_get_mesh);
    const faceCount = info.u32(8);
    return {
      vertexCount: info.u32(4),
      faceCount,
      lodCount: info.u32(16),
      lod: info.u32(20),
      faces: this.numbersAt(info.u32(12), 3 * faceCount),
    };
  }

  /** From "gop" until the next GOP, mesh or seek, and with every frame. */
  gop(): GopInfo {
    const info = this.get(layout.kGopBytes, this.module.exports.tvg_decoder_get_gop);
    return {
      firstFrame: info.u64(8),
      sourceFrame: info.u64(16),
      frameCount: info.u32(24),
      importantVertices: info.u32(28),
      fineStep: info.f64(32),
      coarseStep: info.f64(40),
      mode: kModes[info.u32(48)] ?? "unknown",
      components: info.u32(52),
    };
  }

  /** Importance of each vertex, 0 or 1, into `flags`, vertexCount long. As `gop`. */
  copyFlags(flags: Uint8Array): void {
    const { exports } = this.module;
    const from = this.room(flags.length);
    this.check(exports.tvg_decoder_copy_flags(this.alive(), from, flags.length));
    flags.set(this.bytesAt(from, flags.length));
  }

  /** From "frame" until the next poll or seek. */
  frame(): FrameInfo {
    const info = this.get(layout.kFrameBytes, this.module.exports.tvg_decoder_get_frame);
    return { number: info.u64(8), packetBytes: info.u64(16) };
  }

  /** x, y, z of every vertex of the frame into `to`, [vertex][xyz]. */
  copyPositions(to: Float32Array): void {
    this.copyFloats(to, 12, (at, size) =>
      this.module.exports.tvg_decoder_copy_positions(this.alive(), at, size, 12),
    );
  }

  /** Unit normals of the frame's vertices, weighted by area; 0, 0, 0 for a vertex without a face. */
  computeNormals(to: Float32Array): void {
    this.copyFloats(to, 12, (at, size) =>
      this.module.exports.tvg_decoder_compute_normals(this.alive(), at, size, 12),
    );
  }

  /** From "damage" until the next poll. */
  damage(): DamageInfo {
    const info = this.get(layout.kDamageBytes, this.module.exports.tvg_decoder_get_damage);
    const code: TvgErrorCode = errorCodeName(info.u32(24));
    const byteOffset = info.known(32);
    return {
      firstFrame: info.u64(8),
      frameCount: info.u64(16),
      code,
      message: textAt(this.module, info.u32(40)) ?? "",
      ...(byteOffset === undefined ? {} : { byteOffset }),
    };
  }

  /** The attributes of the mesh, from "mesh" on; those of coarser meshes are none. */
  attributes(): AttributeInfo[] {
    const info = this.get(layout.kPropertiesBytes, this.module.exports.tvg_decoder_get_properties);
    return Array.from({ length: info.u32(4) }, (_, index) => this.attribute(index));
  }

  /** The components of every value of an attribute into `to`, valueCount * components long. */
  copyAttribute(attribute: AttributeInfo, to: Float32Array): void {
    const stride = 4 * attribute.components;
    this.copyFloats(to, stride, (at, size) =>
      this.module.exports.tvg_decoder_copy_attribute(this.alive(), attribute.index, at, size, stride),
    );
  }

  /** Which value of an attribute each corner has, [face][corner], into `to`, 3 * faceCount long. */
  copyCorners(attribute: AttributeInfo, to: Uint32Array): void {
    this.copyNumbers(to, (at, count) =>
      this.module.exports.tvg_decoder_copy_corners(this.alive(), attribute.index, at, count),
    );
  }

  /** The parts of the mesh: none where all faces are one part without a name. */
  parts(): PartInfo[] {
    const { exports } = this.module;
    const count = this.get(layout.kPropertiesBytes, exports.tvg_decoder_get_properties).u32(8);
    return Array.from({ length: count }, (_, part) => {
      const info = this.get(layout.kPartBytes, (decoder, at) => exports.tvg_decoder_get_part(decoder, part, at));
      const [object, group, material] = [4, 8, 12].map((at) => textAt(this.module, info.u32(at)) ?? "");
      return { object: object!, group: group!, material: material! };
    });
  }

  /** The part of each face into `to`, faceCount long. */
  copyFaceParts(to: Uint32Array): void {
    this.copyNumbers(to, (at, count) =>
      this.module.exports.tvg_decoder_copy_face_parts(this.alive(), at, count),
    );
  }

  /** The mesh with one index for all that a vertex has, as graphics hardware draws it; arrays are copies. */
  view(): View {
    const { exports } = this.module;
    const info = this.get(layout.kViewBytes, exports.tvg_decoder_get_view);
    const vertexCount = info.u32(4);
    const indices = this.numbersAt(info.u32(16), info.u32(8));
    const sourceVertices = this.numbersAt(info.u32(20), vertexCount);
    const ranges = Array.from({ length: info.u32(12) }, (_, part) => {
      const range = this.get(layout.kViewRangeBytes, (decoder, at) =>
        exports.tvg_decoder_get_view_range(decoder, part, at),
      );
      return { firstIndex: range.u32(4), indexCount: range.u32(8) };
    });
    return { vertexCount, indices, sourceVertices, ranges };
  }

  /** As copyPositions, for every vertex of the view. */
  copyViewPositions(to: Float32Array): void {
    this.copyFloats(to, 12, (at, size) =>
      this.module.exports.tvg_decoder_copy_view_positions(this.alive(), at, size, 12),
    );
  }

  /** As computeNormals, for every vertex of the view. */
  computeViewNormals(to: Float32Array): void {
    this.copyFloats(to, 12, (at, size) =>
      this.module.exports.tvg_decoder_compute_view_normals(this.alive(), at, size, 12),
    );
  }

  /** As copyAttribute, for every vertex of the view; zeros where it has no value. */
  copyViewAttribute(attribute: AttributeInfo, to: Float32Array): void {
    const stride = 4 * attribute.components;
    this.copyFloats(to, stride, (at, size) =>
      this.module.exports.tvg_decoder_copy_view_attribute(this.alive(), attribute.index, at, size, stride),
    );
  }

  /** Free-form data, from "data" until the next poll, push or seek; still packed where they are. */
  data(): FreeFormData {
    const info = this.get(layout.kDataBytes, this.module.exports.tvg_decoder_get_data);
    const encoding = (["stored", "zstd"] as const)[info.u32(16)] ?? "unknown";
    return {
      name: textAt(this.module, info.u32(4)) ?? "",
      size: info.u64(8),
      encoding,
      bytes: this.bytesAt(info.u32(20), info.u64(24)).slice(),
    };
  }

  /** Where the index of a stream lies, by its last bytes; undefined where they are no tail. */
  locateIndex(tail: Uint8Array, streamBytes: number): { offset: number; bytes: number } | undefined {
    const { exports } = this.module;
    const at = this.room(tail.length);
    this.bytesAt(at, tail.length).set(tail);
    const code = exports.tvg_locate_index(
      at,
      tail.length,
      BigInt(streamBytes),
      this.structure,
      this.structure + 8,
    );
    if (code !== 0) return undefined;
    const found = new Structure(this.module, this.structure, 16);
    return { offset: found.u64(0), bytes: found.u64(8) };
  }

  /** Takes the bytes that locateIndex found, so that seeks can go anywhere at once. */
  loadIndex(bytes: Uint8Array): void {
    const at = this.room(bytes.length);
    this.bytesAt(at, bytes.length).set(bytes);
    this.check(this.module.exports.tvg_decoder_load_index(this.alive(), at, bytes.length));
  }

  /**
   * Goes to a frame, from "head" on: the next "frame" is this one or the first good one after it. The bytes pushed
   * from now on must begin at the offset returned.
   */
  seek(frame: number): number {
    if (!Number.isSafeInteger(frame) || frame < 0) {
      throw new TvgError("invalid-argument", `there is no frame ${frame}`);
    }
    const { exports } = this.module;
    this.check(exports.tvg_decoder_seek(this.alive(), BigInt(frame), this.structure));
    return new Structure(this.module, this.structure, 8).u64(0);
  }

  /** How many of the bytes that come next are of no use; they count as pushed. */
  skip(): number {
    return Number(BigInt.asUintN(64, this.module.exports.tvg_decoder_skip(this.alive())));
  }

  /** Decode only the first components of each basis read from now on: coarser, sooner. */
  useComponents(most: number): void {
    this.check(this.module.exports.tvg_decoder_use_components(this.alive(), most));
  }

  /** Draw meshes read from now on as a coarser one that they have: 1 the first, 0 the whole. */
  useLod(lod: number): void {
    this.check(this.module.exports.tvg_decoder_use_lod(this.alive(), lod));
  }

  /**
   * The planes that the frames of this group are sums of (mode "basis"), so that a GPU can make them; undefined in other
   * modes. As `gop`. Positions are made when they are asked for: who takes rows in their place saves the time.
   */
  basis(): BasisInfo | undefined {
    if (this.gop().mode !== "basis") return undefined;
    const info = this.get(layout.kBasisBytes, this.module.exports.tvg_decoder_get_basis);
    return { number: info.u64(8), vertexCount: info.u32(16), components: info.u32(20), most: info.u32(24) };
  }

  /**
   * The coefficients of planes 4 * group to 4 * group + 3, [vertex][4], into `to`, 4 * vertexCount long; 0 for planes
   * that are not there. 16 bits hold them where `most` is below 32768.
   */
  copyPlanes(group: number, to: Float32Array | Int16Array): void {
    const { exports } = this.module;
    const from = this.room(to.byteLength);
    const isShort = to instanceof Int16Array;
    const copy = isShort ? exports.tvg_decoder_copy_short_planes : exports.tvg_decoder_copy_planes;
    this.check(copy(this.alive(), group, from, to.length));
    to.set(new (isShort ? Int16Array : Float32Array)(exports.memory.buffer, from, to.length));
  }

  /**
   * What the frame's planes are multiplied by, [1 + component][xyz]: vertex v is at the first row and the sum of its
   * coefficients times the row of each.
   */
  copyRows(to: Float32Array): void {
    this.copyFloats(to, 12, (at, size) =>
      this.module.exports.tvg_decoder_copy_rows(this.alive(), at, size / 4),
    );
  }

  private attribute(index: number): AttributeInfo {
    const info = this.get(layout.kAttributeBytes, (decoder, at) =>
      this.module.exports.tvg_decoder_get_attribute(decoder, index, at),
    );
    const name = info.u32(4);
    return {
      index,
      kind: kKinds[info.u32(8)] ?? "generic",
      domain: kDomains[info.u32(12)] ?? "vertex",
      components: info.u32(16),
      bits: info.u32(20),
      animated: info.u32(24) !== 0,
      valueCount: info.u32(28),
      name: textAt(this.module, name) ?? "",
    };
  }
}
