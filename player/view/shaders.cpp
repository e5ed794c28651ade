#include "player/view/shaders.hpp"

namespace tvg::player {

namespace {

constexpr const char* kVersion = "#version 330 core\n";

// Lights hang at the camera, but above and below are those of the sequence. Colours are squares of sRGB until
// the last line.
constexpr const char* kLight = R"(
uniform vec3 up;
#ifdef VALUES
uniform sampler2D colours;
vec3 base_colour(float amount) {
  vec3 base = textureLod(colours, vec2(amount * (255.0 / 256.0) + 0.5 / 256.0, 0.5), 0.0).rgb;
  return base * base;
}
const float gloss = 0.45;
const float evenness = 0.35;  // shadows must not be taken for values
#elif defined(SURFACE)
uniform vec4 factor;
uniform float cutoff;
uniform bool textured;
uniform sampler2D colours;
vec4 surface_colour(vec4 tint, vec2 place) {
  vec4 texel = textured ? texture(colours, place) : vec4(1.0);
  return vec4(tint.rgb * tint.rgb * texel.rgb * texel.rgb, tint.a * texel.a) * factor;
}
const float gloss = 0.45;
const float evenness = 0.15;
#else
uniform vec3 surface;
vec3 base_colour(float amount) { return surface * surface; }
const float gloss = 1.0;
const float evenness = 0.0;
#endif
vec3 lit(vec3 base, vec3 n, vec3 to_eye, bool back) {
  if (back) base *= vec3(0.62, 0.70, 0.84);
  float facing = max(dot(n, to_eye), 0.0);
  vec3 key = vec3(-0.50, 0.66, 0.56);
  vec3 light = mix(vec3(0.130, 0.115, 0.110), vec3(0.30, 0.325, 0.36), 0.5 + 0.5 * dot(n, up));
  light += vec3(0.98, 0.91, 0.80) * max(dot(n, key), 0.0);
  light += vec3(0.10, 0.135, 0.20) * max(dot(n, vec3(0.76, -0.08, 0.645)), 0.0);
  light += vec3(0.06) * facing;
  light = mix(light, vec3(1.05), evenness);
  float shine = max(dot(n, normalize(key + to_eye)), 0.0);
  shine *= shine; shine *= shine; shine *= shine; shine *= shine;
  float rim = 1.0 - facing;
  rim *= rim * rim;
  vec3 colour = base * light + gloss * (0.075 * shine + vec3(0.10, 0.115, 0.14) * rim);
  return sqrt(clamp(colour, 0.0, 1.0));
}
)";

constexpr const char* kMeshVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float value;
layout(location = 3) in vec4 vertex_colour;
layout(location = 4) in vec2 texcoord;
uniform mat4 view;
uniform mat4 projection;
#ifdef POINTS
uniform float point_size;
#endif
#ifdef WIREFRAME
#define OUT(name) vertex_##name
#else
#define OUT(name) name
#endif
out vec3 OUT(at);
#ifndef FLAT
out vec3 OUT(direction);
#endif
#ifdef VALUES
out float OUT(amount);
#endif
#ifdef SURFACE
out vec4 OUT(tint);
out vec2 OUT(place);
#endif
void main() {
  vec4 seen = view * vec4(position, 1.0);
  gl_Position = projection * seen;
  OUT(at) = seen.xyz;
#ifndef FLAT
  OUT(direction) = mat3(view) * normal;
#endif
#ifdef VALUES
  OUT(amount) = value;
#endif
#ifdef SURFACE
  OUT(tint) = vertex_colour;
  OUT(place) = texcoord;
#endif
#ifdef POINTS
  gl_PointSize = point_size;
#endif
}
)";

// Passes triangles on, with each corner's distance in pixels to the three edges; w is how much of the
// wireframe a triangle of its size shows, so that a fine mesh does not drown in its own edges.
constexpr const char* kWireGeometry = R"(
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
uniform vec2 half_viewport;
in vec3 vertex_at[];
out vec3 at;
#ifndef FLAT
in vec3 vertex_direction[];
out vec3 direction;
#endif
#ifdef VALUES
in float vertex_amount[];
out float amount;
#endif
#ifdef SURFACE
in vec4 vertex_tint[];
in vec2 vertex_place[];
out vec4 tint;
out vec2 place;
#endif
noperspective out vec3 to_edge;
flat out float wire;
void main() {
  vec2 p[3];
  bool behind = false;
  for (int i = 0; i < 3; ++i) {
    behind = behind || gl_in[i].gl_Position.w <= 0.0;
    p[i] = half_viewport * gl_in[i].gl_Position.xy / gl_in[i].gl_Position.w;
  }
  vec2 a = p[2] - p[1];
  vec2 b = p[2] - p[0];
  vec2 c = p[1] - p[0];
  float area = abs(b.x * c.y - b.y * c.x);
  vec3 heights = area / max(vec3(length(a), length(b), length(c)), vec3(1e-6));
  float shortest = min(length(a), min(length(b), length(c)));
  for (int i = 0; i < 3; ++i) {
    gl_Position = gl_in[i].gl_Position;
    at = vertex_at[i];
#ifndef FLAT
    direction = vertex_direction[i];
#endif
#ifdef VALUES
    amount = vertex_amount[i];
#endif
#ifdef SURFACE
    tint = vertex_tint[i];
    place = vertex_place[i];
#endif
    to_edge = vec3(0.0);
    to_edge[i] = heights[i];
    wire = behind ? 0.0 : smoothstep(1.0, 9.0, shortest);
    EmitVertex();
  }
}
)";

constexpr const char* kMeshFragment = R"(
in vec3 at;
#ifndef FLAT
in vec3 direction;
#endif
#ifdef VALUES
in float amount;
#else
const float amount = 0.0;
#endif
#ifdef SURFACE
in vec4 tint;
in vec2 place;
#endif
#ifdef WIREFRAME
noperspective in vec3 to_edge;
flat in float wire;
#endif
out vec4 colour;
void main() {
  vec3 to_eye = normalize(-at);
#ifdef POINTS
  vec3 n = to_eye;
  bool back = false;
#else
  bool back = !gl_FrontFacing;
#ifdef FLAT
  vec3 n = cross(dFdx(at), dFdy(at));
#else
  vec3 n = back ? -direction : direction;
  if (dot(n, n) < 1e-8) n = cross(dFdx(at), dFdy(at));
#endif
  n *= inversesqrt(max(dot(n, n), 1e-30));
#endif
#ifdef SURFACE
  vec4 base = surface_colour(tint, place);
  if (base.a < cutoff) discard;
  vec3 seen = lit(base.rgb, n, to_eye, back);
#else
  vec3 seen = lit(base_colour(amount), n, to_eye, back);
#endif
#ifdef WIREFRAME
  float near = min(to_edge.x, min(to_edge.y, to_edge.z));
  seen = mix(seen, vec3(0.10, 0.11, 0.15), (1.0 - smoothstep(0.25, 1.15, near)) * mix(0.12, 0.50, wire));
#endif
  colour = vec4(seen, 1.0);
}
)";

constexpr const char* kBackgroundVertex = R"(
out float height;
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  height = 0.5 + 0.5 * corner.y;
  gl_Position = vec4(corner, 1.0, 1.0);
}
)";

// The noise of half a step keeps the gradient from showing bands.
constexpr const char* kBackgroundFragment = R"(
in float height;
uniform vec3 top;
uniform vec3 bottom;
out vec4 colour;
void main() {
  float t = smoothstep(0.0, 1.0, height);
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
  colour = vec4(mix(bottom, top, t) + noise / 255.0, 1.0);
}
)";

constexpr const char* kGridVertex = R"(
uniform mat4 view;
uniform mat4 projection;
uniform vec3 center;
uniform vec3 along;
uniform vec3 across;
uniform float reach;
uniform vec2 phase;
uniform float cell;
out vec2 place;
out vec2 from_center;
out vec3 at;
void main() {
  from_center = vec2((gl_VertexID & 1) == 0 ? -1.0 : 1.0, (gl_VertexID & 2) == 0 ? -1.0 : 1.0);
  place = from_center * (reach / cell) + phase;
  vec4 seen = view * vec4(center + reach * (from_center.x * along + from_center.y * across), 1.0);
  at = seen.xyz;
  gl_Position = projection * seen;
}
)";

// Lines of a cell and stronger ones of ten cells, a pixel wide at any distance; they fade with the distance
// from the middle, where they crowd, and where one looks along the ground.
constexpr const char* kGridFragment = R"(
in vec2 place;
in vec2 from_center;
in vec3 at;
uniform vec3 ground_normal;
uniform vec3 ink;
uniform float strength;
out vec4 colour;
float lines(vec2 where) {
  vec2 width = max(fwidth(where), vec2(1e-6));
  vec2 off = abs(fract(where - 0.5) - 0.5) / width;
  vec2 line = (1.0 - smoothstep(0.3, 1.2, off)) * (1.0 - smoothstep(0.10, 0.45, width));
  return max(line.x, line.y);
}
void main() {
  float fade = 1.0 - smoothstep(0.15, 1.0, length(from_center));
  float grazing = smoothstep(0.015, 0.16, abs(dot(normalize(at), ground_normal)));
  float covered = strength * max(0.5 * lines(place), lines(place / 5.0));
  colour = vec4(ink, covered * fade * fade * grazing);
}
)";

}  // namespace

ShaderText mesh_shader(const MeshShaderFeatures& features) {
  std::string head = kVersion;
  if (features.flat) head += "#define FLAT\n";
  if (features.wireframe) head += "#define WIREFRAME\n";
  if (features.values) head += "#define VALUES\n";
  if (features.points) head += "#define POINTS\n";
  if (features.surface) head += "#define SURFACE\n";
  return {head + kMeshVertex, features.wireframe ? head + kWireGeometry : std::string(),
          head + kLight + kMeshFragment};
}

ShaderText background_shader() {
  return {std::string(kVersion) + kBackgroundVertex, {}, std::string(kVersion) + kBackgroundFragment};
}

ShaderText grid_shader() {
  return {std::string(kVersion) + kGridVertex, {}, std::string(kVersion) + kGridFragment};
}

}  // namespace tvg::player
