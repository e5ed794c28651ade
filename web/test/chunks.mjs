/** Where the chunks of a stream are (format-spec §3.2). */
export function chunksOf(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const chunks = [];
  for (let at = 8; at + 20 <= bytes.length; ) {
    const to = at + 20 + view.getUint32(at + 8, true);
    chunks.push({ type: String.fromCharCode(...bytes.subarray(at, at + 4)), from: at, to });
    at = to;
  }
  return chunks;
}
