import { TvgError } from "../errors.js";
import type { FreeFormData } from "../types.js";

/** Bytes of one of a stream's data once unpacked, at most (format-spec §4.8). */
const kMostBytes = 1 << 26;

/** The data themselves. The decoder of zstd is three's. */
export async function unpack({ name, size, encoding, bytes }: FreeFormData): Promise<Uint8Array> {
  if (encoding === "stored") return bytes;
  if (encoding !== "zstd") throw new TvgError("unsupported", `"${name}" is packed in a way that is not known`);
  if (size > kMostBytes) throw new TvgError("limit-exceeded", `"${name}" takes ${size} bytes`);
  const { ZSTDDecoder } = await import("three/addons/libs/zstddec.module.js");
  const decoder = new ZSTDDecoder();
  await decoder.init();
  const unpacked = decoder.decode(bytes, size);
  if (unpacked.length !== size) throw new TvgError("malformed", `"${name}" is not ${size} bytes long`);
  return unpacked;
}

/** A picture file as it is to lie in a texture, its last row first. */
export async function pictureOf(data: FreeFormData): Promise<ImageBitmap> {
  const file = new Blob([(await unpack(data)) as BlobPart]);
  const options: ImageBitmapOptions = { imageOrientation: "flipY", premultiplyAlpha: "none", colorSpaceConversion: "none" };
  return createImageBitmap(file, options);
}
