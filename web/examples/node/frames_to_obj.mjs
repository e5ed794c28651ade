// frames_to_obj.mjs STREAM FOLDER: writes every frame of a stream as an OBJ file. STREAM is a file or an address.
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { TvgStream } from "tvg";

const [source, folder] = process.argv.slice(2);
if (!folder) throw new Error("usage: node frames_to_obj.mjs STREAM FOLDER");
const isAddress = /^https?:/.test(source);
const stream = await TvgStream.open(isAddress ? source : new Uint8Array(await readFile(source)), {
  onDamage: ({ firstFrame, frameCount, message }) => console.error(`frames ${firstFrame} +${frameCount}: ${message}`),
});
await mkdir(folder, { recursive: true });

let positions, faces;
for (let event; (event = await stream.next()) !== "end"; ) {
  if (event === "mesh") {
    const mesh = stream.decoder.mesh();
    positions = new Float32Array(3 * mesh.vertexCount);
    faces = Array.from({ length: mesh.faceCount }, (_, face) => `f ${[...mesh.faces.subarray(3 * face, 3 * face + 3)].map((vertex) => vertex + 1).join(" ")}`);
    continue;
  }
  stream.decoder.copyPositions(positions);
  const vertices = Array.from({ length: positions.length / 3 }, (_, vertex) => `v ${positions.subarray(3 * vertex, 3 * vertex + 3).join(" ")}`);
  const name = `${String(stream.frameNumber).padStart(5, "0")}.obj`;
  await writeFile(join(folder, name), [...vertices, ...faces, ""].join("\n"));
}
console.log(`${folder}: ${stream.frameCount ?? stream.frameNumber + 1} frames`);
stream.dispose();
