// A server on loopback for the page's tests: files with ranges, slow lines, connections that are cut, a live stream.
import { existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { chunksOf } from "./chunks.mjs";

const types = { html: "text/html", js: "text/javascript", css: "text/css", wasm: "application/wasm", tvg: "model/vnd.tvg", png: "image/png", json: "application/json" };
const packed = new Set(["html", "js", "css", "wasm"]);
const kTick = 20;

/**
 * `folder` holds the page, `files` (name to bytes) stand before what lies there. `bytesPerSecond` is the line's, over
 * all connections; `cutAfter` ends the next `cuts` answers with a stream after so many bytes.
 */
export async function servePage(folder, files = {}) {
  const state = { files, bytesPerSecond: Infinity, latency: 0, cutAfter: Infinity, cuts: 0, requests: [], live: undefined, sent: 0 };
  let last = performance.now();
  const waiting = new Set();
  const refill = setInterval(() => {
    const now = performance.now();
    const budget = (state.bytesPerSecond * Math.min(now - last, 200)) / 1000;
    last = now;
    const pumps = [...waiting];
    for (const pump of pumps) pump(Math.ceil(budget / pumps.length));
  }, kTick);

  function send(response, body) {
    let at = 0;
    const pump = (share) => {
      if (response.destroyed || at >= body.length) return waiting.delete(pump);
      // What the other side does not take is not sent.
      if (response.writableLength > 1 << 16) return undefined;
      const piece = body.subarray(at, at + share);
      at += piece.length;
      state.sent += piece.length;
      if (at < body.length) return response.write(piece);
      waiting.delete(pump);
      return response.end(piece);
    };
    if (state.bytesPerSecond === Infinity) pump(body.length);
    else waiting.add(pump);
  }

  const server = createServer(async (request, response) => {
    const name = request.url.split("?")[0].slice(1) || "index.html";
    state.requests.push(`${name} ${request.headers.range ?? ""}`.trim());
    if (state.latency > 0) await new Promise((done) => setTimeout(done, state.latency));
    if (name.startsWith("live/")) return state.live ? state.live(response) : response.writeHead(404).end();
    const file = join(folder, name);
    const body = state.files[name] ?? (existsSync(file) ? readFileSync(file) : undefined);
    if (!body) return response.writeHead(404).end();
    const range = /^bytes=(\d+)-(\d*)$/.exec(request.headers.range ?? "");
    const from = range ? Number(range[1]) : 0;
    const to = range?.[2] ? Math.min(Number(range[2]) + 1, body.length) : body.length;
    const kind = name.split(".").pop();
    const headers = { "Content-Type": types[kind] ?? "application/octet-stream", "Content-Length": to - from };
    // As hosts are set up.
    if (packed.has(kind)) {
      const answer = gzipSync(body);
      response.writeHead(200, { ...headers, "Content-Length": answer.length, "Content-Encoding": "gzip" });
      return send(response, answer);
    }
    if (range) headers["Content-Range"] = `bytes ${from}-${to - 1}/${body.length}`;
    response.writeHead(range ? 206 : 200, headers);
    if (name.endsWith(".tvg") && to - from > state.cutAfter && state.cuts-- > 0) {
      return response.write(body.subarray(from, from + state.cutAfter), () => setTimeout(() => response.destroy(), 30));
    }
    send(response, body.subarray(from, to));
  });
  await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
  return Object.assign(state, {
    url: `http://127.0.0.1:${server.address().port}/`,
    close: () => {
      clearInterval(refill);
      server.closeAllConnections?.();
      return new Promise((done) => server.close(done));
    },
  });
}

/**
 * A live answer: the head of a stream and its groups of frames, one every `seconds`, again and again or so many. When it
 * has sent each once it may end properly; `cut` breaks it off.
 */
export function liveAnswer(bytes, { seconds, groups = Infinity, cut = false }) {
  const chunks = chunksOf(bytes);
  const firstGop = chunks.findIndex(({ type }) => type === "GOP ");
  const gops = chunks.filter(({ type }) => type === "GOP ");
  return (response) => {
    response.writeHead(200, { "Content-Type": "model/vnd.tvg", "Cache-Control": "no-store" });
    response.write(bytes.subarray(0, chunks[firstGop].from));
    const end = gops[gops.length - 1].to;
    let sent = 0;
    const step = () => {
      if (response.destroyed) return;
      const { from, to } = gops[sent % gops.length];
      if (sent++ < groups) {
        response.write(bytes.subarray(from, to));
        setTimeout(step, 1000 * seconds);
      } else if (cut) response.destroy();
      else response.end(groups === gops.length ? bytes.subarray(end) : undefined);
    };
    step();
  };
}
