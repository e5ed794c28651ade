// Long streams of a short one, so that tests have something to wait for.
import { chunksOf } from "./chunks.mjs";
import { xxh64 } from "./toolbox.mjs";

const checksum = (bytes) => Number(BigInt(`0x${xxh64(bytes)}`) & 0xffffffffn);

/** A chunk as it stands in a stream (format-spec §3.2). */
export function chunk(type, payload, ancillary = true) {
  const bytes = new Uint8Array(16 + payload.length + 4);
  const view = new DataView(bytes.buffer);
  bytes.set([...type].map((letter) => letter.charCodeAt(0)));
  view.setUint32(4, ancillary ? 1 : 0, true);
  view.setUint32(8, payload.length, true);
  view.setUint32(12, checksum(bytes.subarray(0, 12)), true);
  bytes.set(payload, 16);
  view.setUint32(16 + payload.length, checksum(payload), true);
  return bytes;
}

function varint(value) {
  const bytes = [];
  for (; value > 127; value = Math.floor(value / 128)) bytes.push((value % 128) | 128);
  return [...bytes, value];
}

/**
 * The groups of a stream of one mesh again and again, each with so many bytes before it that mean nothing. `frames` are
 * those of each of its groups in turn; `data`, by their names, go along as they are.
 */
export function longStream(bytes, { repeats, padding = 0, frames, data = {} }) {
  const chunks = chunksOf(bytes);
  const gops = chunks.filter(({ type }) => type === "GOP ");
  const pad = chunk("xtra", new Uint8Array(padding));
  const pieces = [bytes.subarray(0, 8)];
  const entries = [];
  let at = 8;
  let last = 0;
  const add = (piece) => {
    pieces.push(piece);
    at += piece.length;
  };
  const enter = (kind, ...fields) => {
    entries.push(...varint(kind), ...varint(at - last), ...varint(fields.length), ...fields);
    last = at;
  };
  for (const { type, from, to } of chunks) {
    if (type === "GOP ") break;
    if (type === "MESH") {
      for (const [name, value] of Object.entries(data)) add(chunk("DATA", dataPayload(name, value)));
      enter(1);
    }
    add(bytes.subarray(from, to));
  }
  let count = 0;
  for (let i = 0; i < repeats * gops.length; ++i) {
    if (padding > 0) add(pad);
    const { from, to } = gops[i % gops.length];
    enter(3, ...varint(frames[i % gops.length]), 1, 0);
    ++count;
    add(bytes.subarray(from, to));
  }
  const index = chunk("INDX", Uint8Array.from([...varint(count + 1), ...entries]));
  const distance = new Uint8Array(8);
  new DataView(distance.buffer).setUint32(0, index.length, true);
  return new Uint8Array(Buffer.concat([...pieces, index, chunk("TAIL", distance, false)]));
}

/** Of free-form data that are stored as they are (format-spec §4.8). */
function dataPayload(name, value) {
  const text = new TextEncoder().encode(name);
  return Uint8Array.from([...varint(text.length), ...text, 0, ...varint(value.length), ...value]);
}
