// What the tests share. TVG_PACKAGE is the folder of the built package, TVG_CONFORMANCE that of the streams.
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

export const packageFolder = process.env.TVG_PACKAGE;
const conformance = process.env.TVG_CONFORMANCE;
export const tvg = await import(pathToFileURL(join(packageFolder, "dist/index.js")).href);

export const streamBytes = (name) => new Uint8Array(readFileSync(join(conformance, `${name}.tvg`)));

/** The rows of digests.txt by the names of their streams. */
export function digests() {
  const rows = readFileSync(join(conformance, "digests.txt"), "utf8")
    .split("\n")
    .filter((line) => line && !line.startsWith("#"))
    .map((line) => line.split(" "));
  return rows.map(([name, , frames, vertices, faces, , positions]) => ({ name, frames: +frames, vertices: +vertices, faces: +faces, positions }));
}

const mask = 0xffffffffffffffffn;
const [p1, p2, p3, p4, p5] = [
  0x9e3779b185ebca87n, 0xc2b2ae3d27d4eb4fn, 0x165667b19e3779f9n, 0x85ebca77c2b2ae63n, 0x27d4eb2f165667c5n,
];
const rotate = (value, by) => ((value << by) | (value >> (64n - by))) & mask;
const round = (sum, lane) => (rotate((sum + lane * p2) & mask, 31n) * p1) & mask;
const merge = (hash, lane) => ((hash ^ round(0n, lane)) * p1 + p4) & mask;

/** XXH64 of some bytes, seed 0, as 16 digits. */
export function xxh64(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = 0;
  let hash = p5;
  if (bytes.length >= 32) {
    const lanes = [(p1 + p2) & mask, p2, 0n, (mask + 1n - p1) & mask];
    for (; at + 32 <= bytes.length; at += 32) {
      for (let i = 0; i < 4; ++i) lanes[i] = round(lanes[i], view.getBigUint64(at + 8 * i, true));
    }
    hash = (rotate(lanes[0], 1n) + rotate(lanes[1], 7n) + rotate(lanes[2], 12n) + rotate(lanes[3], 18n)) & mask;
    for (const lane of lanes) hash = merge(hash, lane);
  }
  hash = (hash + BigInt(bytes.length)) & mask;
  for (; at + 8 <= bytes.length; at += 8) {
    hash = (rotate(hash ^ round(0n, view.getBigUint64(at, true)), 27n) * p1 + p4) & mask;
  }
  if (at + 4 <= bytes.length) {
    hash = (rotate(hash ^ ((BigInt(view.getUint32(at, true)) * p1) & mask), 23n) * p2 + p3) & mask;
    at += 4;
  }
  for (; at < bytes.length; ++at) hash = (rotate(hash ^ ((BigInt(bytes[at]) * p5) & mask), 11n) * p1) & mask;
  hash = ((hash ^ (hash >> 33n)) * p2) & mask;
  hash = ((hash ^ (hash >> 29n)) * p3) & mask;
  return (hash ^ (hash >> 32n)).toString(16).padStart(16, "0");
}

/** The digest of all frames' positions that a stream gives. */
export async function positionsDigest(stream) {
  const frames = [];
  for (let event; (event = await stream.next()) !== "end"; ) {
    if (event !== "frame") continue;
    const positions = new Float32Array(3 * stream.decoder.mesh().vertexCount);
    stream.decoder.copyPositions(positions);
    frames.push(Buffer.from(positions.buffer));
  }
  return { frames: frames.length, positions: xxh64(new Uint8Array(Buffer.concat(frames))) };
}

/** Serves one stream on loopback; `ranges` false ignores Range, `cutAfter` ends the first answers early. */
export async function serve(bytes, { ranges = true, cutAfter = Infinity, cuts = 0 } = {}) {
  const requests = [];
  const server = createServer((request, response) => {
    const range = /^bytes=(\d+)-(\d*)$/.exec(request.headers.range ?? "");
    requests.push(request.headers.range ?? "all");
    const from = ranges && range ? Number(range[1]) : 0;
    const to = ranges && range && range[2] ? Number(range[2]) + 1 : bytes.length;
    const headers = { "Content-Length": to - from };
    if (ranges && range) headers["Content-Range"] = `bytes ${from}-${to - 1}/${bytes.length}`;
    response.writeHead(ranges && range ? 206 : 200, headers);
    if (to - from > cutAfter && cuts-- > 0) {
      response.write(bytes.subarray(from, from + cutAfter), () => setTimeout(() => response.destroy(), 20));
    } else {
      response.end(bytes.subarray(from, to));
    }
  });
  await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
  const close = () => new Promise((done) => (server.closeAllConnections?.(), server.close(done)));
  return { url: `http://127.0.0.1:${server.address().port}/a.tvg`, requests, close };
}
