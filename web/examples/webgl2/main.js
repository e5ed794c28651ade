// A stream in mode basis without any library: the planes of a period are a texture array, a frame is a few uniforms,
// and the vertex shader makes the positions. Streams in other modes come as positions, which this draws too.
import { LocalHost, TvgPlayer, WorkerHost } from "tvg";
import { cameraAround } from "./camera.js";

const kMostLayers = 64; // of four planes: 192 of the 256 vectors of uniforms that every WebGL2 has
const vertexShader = `#version 300 es
precision highp float;
precision highp int;
precision highp isampler2DArray;
precision highp sampler2DArray;
uniform isampler2DArray shortPlanes;
uniform sampler2DArray floatPlanes;
uniform int layers; // 0: positions come as they are
uniform bool isShort;
uniform vec3 base;
uniform mat3x4 rows[${kMostLayers}];
uniform mat4 camera;
layout(location = 0) in vec3 position;
layout(location = 1) in uint vertex;
out vec3 place;
void main() {
  place = layers > 0 ? base : position;
  int width = isShort ? textureSize(shortPlanes, 0).x : textureSize(floatPlanes, 0).x;
  ivec2 at = ivec2(int(vertex) % width, int(vertex) / width);
  for (int layer = 0; layer < layers; ++layer) {
    ivec3 texel = ivec3(at, layer);
    vec4 four = isShort ? vec4(texelFetch(shortPlanes, texel, 0)) : texelFetch(floatPlanes, texel, 0);
    place += four * rows[layer];
  }
  gl_Position = camera * vec4(place, 1.0);
}`;
const fragmentShader = `#version 300 es
precision highp float;
in vec3 place;
out vec4 colour;
void main() { // Each face has the normal of its own plane.
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
  colour = vec4(vec3(0.25 + 0.65 * abs(dot(normal, normalize(vec3(0.4, 0.7, 0.6))))), 1.0);
}`;

const canvas = document.body.appendChild(document.createElement("canvas"));
const gl = canvas.getContext("webgl2", { antialias: true });
const program = gl.createProgram();
for (const [type, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  gl.attachShader(program, shader);
}
// What transform feedback would write, for who wants the positions back.
gl.transformFeedbackVaryings(program, ["place"], gl.SEPARATE_ATTRIBS);
gl.linkProgram(program);
if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
gl.useProgram(program);
gl.enable(gl.DEPTH_TEST);
const names = ["shortPlanes", "floatPlanes", "layers", "isShort", "base", "rows", "camera"];
const uniform = Object.fromEntries(names.map((name) => [name, gl.getUniformLocation(program, name)]));
gl.uniform1i(uniform.shortPlanes, 0);
gl.uniform1i(uniform.floatPlanes, 1);

const [positions, vertices, indices] = [0, 0, 0].map(() => gl.createBuffer());
const textures = [gl.TEXTURE0, gl.TEXTURE1].map((unit, i) => {
  const texture = gl.createTexture();
  gl.activeTexture(unit);
  gl.bindTexture(gl.TEXTURE_2D_ARRAY, texture);
  gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  // Every sampler wants a texture of its kind, used or not.
  if (i === 0) gl.texImage3D(gl.TEXTURE_2D_ARRAY, 0, gl.RGBA16I, 1, 1, 1, 0, gl.RGBA_INTEGER, gl.SHORT, null);
  else gl.texImage3D(gl.TEXTURE_2D_ARRAY, 0, gl.RGBA32F, 1, 1, 1, 0, gl.RGBA, gl.FLOAT, null);
  return unit;
});

const stream = new URLSearchParams(location.search).get("stream") ?? "clip.tvg";
const worker = () => new Worker(new URL("node_modules/tvg/dist/worker.js", document.baseURI), { type: "module" });
const player = new TvgPlayer(stream, {
  host: typeof Worker === "undefined" ? new LocalHost() : new WorkerHost(worker()),
  gpu: { textureSize: gl.getParameter(gl.MAX_TEXTURE_SIZE), layers: kMostLayers, components: 4 * kMostLayers },
});
let planes;
let camera;

player.addEventListener("mesh", () => {
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indices);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, player.mesh.indices, gl.STATIC_DRAW);
  gl.bindBuffer(gl.ARRAY_BUFFER, vertices);
  gl.bufferData(gl.ARRAY_BUFFER, player.mesh.sourceVertices, gl.STATIC_DRAW);
  gl.enableVertexAttribArray(1);
  gl.vertexAttribIPointer(1, 1, gl.UNSIGNED_INT, 0, 0);
  planes = undefined;
});

player.addEventListener("frame", () => {
  const { frame } = player;
  if (frame.rows) takeRows(frame);
  else takePositions(frame.positions);
  camera ??= cameraAround(frame.rows ? frame.planes.positions : frame.positions);
});

function takePositions(values) {
  gl.uniform1i(uniform.layers, 0);
  gl.bindBuffer(gl.ARRAY_BUFFER, positions);
  gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
}

/** Once for a period: its planes; for each frame: x, y and z of its rows, four planes at a time. */
function takeRows(frame) {
  if (frame.planes !== planes) upload((planes = frame.planes));
  const rows = new Float32Array(12 * planes.layers);
  for (let a = 0; a < planes.components; ++a) {
    for (let axis = 0; axis < 3; ++axis) rows[12 * (a >> 2) + 4 * axis + (a & 3)] = frame.rows[3 * (a + 1) + axis];
  }
  gl.disableVertexAttribArray(0);
  gl.uniform1i(uniform.layers, planes.layers);
  gl.uniform3fv(uniform.base, frame.rows.subarray(0, 3));
  gl.uniformMatrix3x4fv(uniform.rows, false, rows);
}

function upload({ coefficients, width, height, layers }) {
  const isShort = coefficients instanceof Int16Array;
  gl.activeTexture(textures[isShort ? 0 : 1]);
  const [kept, format, type] = isShort ? [gl.RGBA16I, gl.RGBA_INTEGER, gl.SHORT] : [gl.RGBA32F, gl.RGBA, gl.FLOAT];
  gl.texImage3D(gl.TEXTURE_2D_ARRAY, 0, kept, width, height, layers, 0, format, type, coefficients);
  gl.uniform1i(uniform.isShort, isShort ? 1 : 0);
}

function draw() {
  [canvas.width, canvas.height] = [innerWidth, innerHeight];
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.uniformMatrix4fv(uniform.camera, false, camera(canvas.width / canvas.height));
  gl.drawElements(gl.TRIANGLES, player.mesh.indices.length, gl.UNSIGNED_INT, 0);
}

let last;
player.loop = true;
player.addEventListener("canplay", () => player.play());
player.addEventListener("error", () => console.error(player.error));
requestAnimationFrame(function step(now) {
  player.update(last === undefined ? 0 : (now - last) / 1000);
  last = now;
  if (camera) draw();
  requestAnimationFrame(step);
});
Object.assign(globalThis, { player, gl, program });
