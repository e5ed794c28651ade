// How a GPU makes a frame of mode "basis" (GLSL ES 3.00): two passes over targets of a texel for each vertex.

/** Layers that the uniform `rows` has room for: shaders for a few more planes stay the same. */
export const kLayerStep = 16;

/** A triangle over all of the target. */
export const kFillVertexShader = `
in vec3 position;
void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }
`;

/** Positions: four planes to a layer; `rows` has x, y and z of four rows each. */
export const positionsShader = (layerRoom: number, isShort: boolean): string => `
precision highp float;
precision highp int;
precision highp ${isShort ? "isampler2DArray" : "sampler2DArray"};
uniform ${isShort ? "isampler2DArray" : "sampler2DArray"} planes;
uniform int layers;
uniform vec3 base;
uniform vec4 rows[${3 * layerRoom}];
out vec4 result;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 sum = base;
  for (int layer = 0; layer < layers; ++layer) {
    vec4 four = vec4(texelFetch(planes, ivec3(at, layer), 0));
    sum += vec3(dot(four, rows[3 * layer]), dot(four, rows[3 * layer + 1]), dot(four, rows[3 * layer + 2]));
  }
  result = vec4(sum, 1.0);
}
`;

/** Unit normals, weighted by area: `fans` says of each vertex where its faces' other corners begin and how many. */
export const kNormalsShader = `
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
uniform sampler2D positions;
uniform usampler2D fans;
uniform usampler2D corners;
out vec4 result;
ivec2 texel(uint number, int width) { return ivec2(int(number) % width, int(number) / width); }
void main() {
  int width = textureSize(positions, 0).x;
  int cornersWidth = textureSize(corners, 0).x;
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 here = texelFetch(positions, at, 0).xyz;
  uvec2 fan = texelFetch(fans, at, 0).xy;
  vec3 sum = vec3(0.0);
  for (uint i = 0u; i < fan.y; ++i) {
    uvec2 others = texelFetch(corners, texel(fan.x + i, cornersWidth), 0).xy;
    vec3 b = texelFetch(positions, texel(others.x, width), 0).xyz - here;
    vec3 c = texelFetch(positions, texel(others.y, width), 0).xyz - here;
    sum += cross(b, c);
  }
  float size = length(sum);
  result = vec4(size > 0.0 ? sum / size : vec3(0.0), 0.0);
}
`;

/** The rows of a frame as `base` and `rows` have them; `rows` is 12 * layers long at least. */
export function packRows(frame: Float32Array, base: Float32Array, rows: Float32Array): void {
  base.set(frame.subarray(0, 3));
  rows.fill(0);
  for (let component = 0, at = 3; at < frame.length; ++component, at += 3) {
    const to = 12 * (component >> 2) + (component & 3);
    rows[to] = frame[at]!;
    rows[to + 4] = frame[at + 1]!;
    rows[to + 8] = frame[at + 2]!;
  }
}
