#include "player/view/mesh_renderer.hpp"

#include "player/view/draft_faces.hpp"
#include "player/view/shaders.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace tvg::player {

namespace {

constexpr GLuint kPositionAttribute = 0;
constexpr GLuint kNormalAttribute = 1;
constexpr GLuint kValueAttribute = 2;
constexpr GLuint kColourAttribute = 3;
constexpr GLuint kTexcoordAttribute = 4;

/// Below this, faces are larger than pixels, and a software renderer keeps up.
constexpr std::size_t kManyFaces = 60000;

/// Replaces a buffer's content. The driver may still draw the old one: it gets new memory, so that nobody
/// waits.
void stream(const GlBuffer& buffer, std::span<const float> values) {
  const auto bytes = static_cast<GLsizeiptr>(values.size_bytes());
  glBindBuffer(GL_ARRAY_BUFFER, buffer.get());
  glBufferData(GL_ARRAY_BUFFER, bytes, nullptr, GL_STREAM_DRAW);
  glBufferSubData(GL_ARRAY_BUFFER, 0, bytes, values.data());
}

/// Through a target that no vertex array remembers.
void send_faces(const GlBuffer& buffer, std::span<const Face> faces) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(faces.size_bytes()), faces.data(), GL_STATIC_DRAW);
}

void set_attribute(GLuint attribute, bool present) {
  if (present) {
    glEnableVertexAttribArray(attribute);
  } else {
    glDisableVertexAttribArray(attribute);
    glVertexAttrib3f(attribute, 0, 0, 0);
  }
}

/// What does not change with frames. Where it is absent, vertices are white and at the picture's corner.
void send_attribute(GLuint attribute, const GlBuffer& buffer, std::span<const float> values) {
  if (values.empty()) {
    glDisableVertexAttribArray(attribute);
    glVertexAttrib4f(attribute, 1, 1, 1, 1);
    return;
  }
  glBindBuffer(GL_ARRAY_BUFFER, buffer.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(values.size_bytes()), values.data(), GL_STATIC_DRAW);
  glEnableVertexAttribArray(attribute);
}

GlTexture make_picture(const Image& image) {
  GlTexture texture = make_texture();
  glBindTexture(GL_TEXTURE_2D, texture.get());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               image.pixels.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glBindTexture(GL_TEXTURE_2D, 0);
  return texture;
}

void set_colour(GLint place, const cli::Colour& colour) {
  glUniform3f(place, colour.red, colour.green, colour.blue);
}

void set_vector(GLint place, const AxisDirection& direction) {
  const std::array<double, 3> vector = direction.vector();
  glUniform3f(place, static_cast<float>(vector[0]), static_cast<float>(vector[1]),
              static_cast<float>(vector[2]));
}

/// A direction of the sequence as the camera sees it.
void set_direction(GLint place, const CameraMatrices& matrices, const AxisDirection& direction) {
  const float* const column = matrices.view.data() + 4 * direction.axis;
  const auto sign = static_cast<float>(direction.sign);
  glUniform3f(place, sign * column[0], sign * column[1], sign * column[2]);
}

/// 1, 2 or 5 times a power of ten, near `length`.
double round_length(double length) {
  const double power = std::pow(10, std::floor(std::log10(length)));
  const double digits = length / power;
  return power * (digits < 1.5 ? 1 : digits < 3.5 ? 2 : digits < 7.5 ? 5 : 10);
}

}  // namespace

MeshRenderer::MeshRenderer()
    : mesh_array_(make_vertex_array()),
      empty_array_(make_vertex_array()),
      positions_(make_buffer()),
      normals_(make_buffer()),
      values_(make_buffer()),
      faces_(make_buffer()),
      draft_faces_(make_buffer()),
      surface_faces_(make_buffer()),
      vertex_colours_(make_buffer()),
      texcoords_(make_buffer()),
      colours_(make_texture()),
      background_(make_program(background_shader())),
      grid_(make_program(grid_shader())) {
  glBindVertexArray(mesh_array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, positions_.get());
  glVertexAttribPointer(kPositionAttribute, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  glEnableVertexAttribArray(kPositionAttribute);
  glBindBuffer(GL_ARRAY_BUFFER, normals_.get());
  glVertexAttribPointer(kNormalAttribute, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  glBindBuffer(GL_ARRAY_BUFFER, values_.get());
  glVertexAttribPointer(kValueAttribute, 1, GL_FLOAT, GL_FALSE, 0, nullptr);
  glBindBuffer(GL_ARRAY_BUFFER, vertex_colours_.get());
  glVertexAttribPointer(kColourAttribute, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
  glBindBuffer(GL_ARRAY_BUFFER, texcoords_.get());
  glVertexAttribPointer(kTexcoordAttribute, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  glBindVertexArray(0);
}

void MeshRenderer::set_mesh(const Mesh& mesh, std::shared_ptr<const Surface> surface) {
  vertex_count_ = mesh.vertex_count;
  face_count_ = mesh.faces.size();
  has_frame_ = false;
  set_surface(std::move(surface));
  send_faces(faces_, mesh.faces);
  const std::vector<Face> fewer = face_count_ < kManyFaces ? std::vector<Face>() : draft_faces(mesh);
  draft_face_count_ = fewer.size();
  send_faces(draft_faces_, fewer);
}

void MeshRenderer::set_surface(std::shared_ptr<const Surface> surface) {
  // The next mesh of a sequence often has the pictures of the one before, which surface_ keeps till here.
  std::map<const Image*, GlTexture> pictures;
  for (const Surface::Run& run : surface != nullptr ? surface->runs : std::vector<Surface::Run>()) {
    const Image* const image = run.material.texture.get();
    if (image == nullptr || pictures.contains(image)) continue;
    const auto known = pictures_.find(image);
    pictures.emplace(image, known != pictures_.end() ? std::move(known->second) : make_picture(*image));
  }
  pictures_ = std::move(pictures);
  surface_ = std::move(surface);
  if (surface_ == nullptr) return;
  const std::span<const std::uint32_t> indices = surface_->view.indices();
  glBindBuffer(GL_ARRAY_BUFFER, surface_faces_.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size_bytes()), indices.data(),
               GL_STATIC_DRAW);
  glBindVertexArray(mesh_array_.get());
  send_attribute(kColourAttribute, vertex_colours_, surface_->colours);
  send_attribute(kTexcoordAttribute, texcoords_, surface_->texcoords);
  glBindVertexArray(0);
}

void MeshRenderer::set_scene(const BoundingBox& bounds, const Orientation& orientation) {
  scene_ = bounds;
  orientation_ = orientation;
}

void MeshRenderer::set_frame(std::span<const float> positions, std::span<const float> normals,
                             std::span<const float> values, cli::ColourMap map,
                             std::span<const float> colours) {
  const std::size_t coordinates = 3 * std::size_t{vertex_count_};
  const bool is_nothing = vertex_count_ <= 1 && face_count_ == 0;  // as shows_nothing() has it
  has_frame_ = !is_nothing && positions.size() >= coordinates;
  if (!has_frame_) return;
  has_normals_ = normals.size() >= coordinates;
  has_values_ = values.size() >= vertex_count_;
  shows_surface_ = surface_ != nullptr && !has_values_;
  if (shows_surface_) {
    surface_frame_.set(*surface_, positions, colours);
    positions = surface_frame_.positions();
    if (has_normals_) normals = surface_frame_.normals();
  } else {
    positions = positions.first(coordinates);
    if (has_normals_) normals = normals.first(coordinates);
  }
  glBindVertexArray(mesh_array_.get());
  stream(positions_, positions);
  if (has_normals_) stream(normals_, normals);
  if (has_values_) stream(values_, values.first(vertex_count_));
  if (shows_surface_ && !surface_frame_.colours().empty()) {
    stream(vertex_colours_, surface_frame_.colours());
    glEnableVertexAttribArray(kColourAttribute);
  }
  set_attribute(kNormalAttribute, has_normals_);
  set_attribute(kValueAttribute, has_values_);
  glBindVertexArray(0);
  if (has_values_) use_colour_map(map);
}

void MeshRenderer::use_colour_map(cli::ColourMap map) {
  if (colours_shown_ == static_cast<int>(map)) return;
  colours_shown_ = static_cast<int>(map);
  const auto samples = cli::colour_map_samples(map);
  glBindTexture(GL_TEXTURE_2D, colours_.get());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, cli::kColourMapSamples, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               samples.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glBindTexture(GL_TEXTURE_2D, 0);
}

const MeshRenderer::MeshProgram& MeshRenderer::mesh_program(const Style& style) {
  const bool points = face_count_ == 0;
  MeshShaderFeatures features;
  features.flat = points || style.shading == Shading::kFlat || !has_normals_;
  features.wireframe = style.wireframe && !points;
  features.values = has_values_;
  features.points = points;
  features.surface = shows_surface_;
  MeshProgram& program =
      programs_[(features.flat ? 1U : 0U) | (features.wireframe ? 2U : 0U) | (features.values ? 4U : 0U) |
                (features.points ? 8U : 0U) | (features.surface ? 16U : 0U)];
  if (!program.program) {
    program.program = make_program(mesh_shader(features));
    const GLuint name = program.program.get();
    program.view = glGetUniformLocation(name, "view");
    program.projection = glGetUniformLocation(name, "projection");
    program.up = glGetUniformLocation(name, "up");
    program.surface = glGetUniformLocation(name, "surface");
    program.half_viewport = glGetUniformLocation(name, "half_viewport");
    program.point_size = glGetUniformLocation(name, "point_size");
    program.factor = glGetUniformLocation(name, "factor");
    program.cutoff = glGetUniformLocation(name, "cutoff");
    program.textured = glGetUniformLocation(name, "textured");
  }
  return program;
}

void MeshRenderer::draw(const OrbitCamera& camera, const Style& style, const Viewport& viewport) {
  draw_background(style, viewport);
  glEnable(GL_SCISSOR_TEST);
  glDepthMask(GL_TRUE);
  glClearDepth(1);
  glClear(GL_DEPTH_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
  const CameraMatrices matrices = camera.matrices(viewport.aspect());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  if (has_frame_) draw_mesh(matrices, style, viewport);
  if (style.grid) draw_grid(matrices, style, viewport);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(0);
  glUseProgram(0);
}

void MeshRenderer::draw_background(const Style& style, const Viewport& viewport) {
  glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
  glScissor(viewport.x, viewport.y, viewport.width, viewport.height);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glUseProgram(background_.get());
  set_colour(glGetUniformLocation(background_.get(), "top"), style.background_top);
  set_colour(glGetUniformLocation(background_.get(), "bottom"), style.background_bottom);
  glBindVertexArray(empty_array_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void MeshRenderer::draw_mesh(const CameraMatrices& matrices, const Style& style, const Viewport& viewport) {
  const MeshProgram& program = mesh_program(style);
  glUseProgram(program.program.get());
  glUniformMatrix4fv(program.view, 1, GL_FALSE, matrices.view.data());
  glUniformMatrix4fv(program.projection, 1, GL_FALSE, matrices.projection.data());
  set_direction(program.up, matrices, orientation_.up());
  set_colour(program.surface, style.surface);
  glUniform2f(program.half_viewport, static_cast<float>(viewport.width) / 2,
              static_cast<float>(viewport.height) / 2);
  glUniform1f(program.point_size, std::max(2.0F, static_cast<float>(viewport.height) / 200));
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, has_values_ ? colours_.get() : 0);
  glBindVertexArray(mesh_array_.get());
  if (face_count_ == 0) {
    if (shows_surface_) use_material(program, {});
    glEnable(GL_PROGRAM_POINT_SIZE);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(vertex_count_));
    glDisable(GL_PROGRAM_POINT_SIZE);
  } else if (shows_surface_) {
    draw_runs(program, style);
  } else {
    draw_faces(style);
  }
  glBindTexture(GL_TEXTURE_2D, 0);
}

void MeshRenderer::draw_faces(const Style& style) {
  const bool draft = style.draft && draft_face_count_ > 0 && style.shading == Shading::kSmooth &&
                     has_normals_ && !style.wireframe;
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, (draft ? draft_faces_ : faces_).get());
  const std::size_t faces = draft ? draft_face_count_ : face_count_;
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * faces), GL_UNSIGNED_INT, nullptr);
}

void MeshRenderer::draw_runs(const MeshProgram& program, const Style& style) {
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, surface_faces_.get());
  for (const Surface::Run& run : surface_->runs) {
    ShownMaterial material = run.material;
    if (run.is_plain && surface_->colours.empty() && surface_frame_.colours().empty()) {
      const cli::Colour& plain = style.surface;
      material.factor = {plain.red * plain.red, plain.green * plain.green, plain.blue * plain.blue, 1};
    }
    use_material(program, material);
    const auto* const first = reinterpret_cast<const void*>(run.faces.first_index * sizeof(std::uint32_t));
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(run.faces.index_count), GL_UNSIGNED_INT, first);
  }
}

void MeshRenderer::use_material(const MeshProgram& program, const ShownMaterial& material) {
  const bool textured = material.texture != nullptr && !surface_->texcoords.empty();
  glUniform4fv(program.factor, 1, material.factor.data());
  glUniform1f(program.cutoff, material.cutoff);
  glUniform1i(program.textured, textured ? 1 : 0);
  glBindTexture(GL_TEXTURE_2D, textured ? pictures_.at(material.texture.get()).get() : 0);
}

void MeshRenderer::draw_grid(const CameraMatrices& matrices, const Style& style, const Viewport& viewport) {
  const GLuint program = grid_.get();
  const auto place = [program](const char* name) { return glGetUniformLocation(program, name); };
  const AxisDirection upwards = orientation_.up();
  const std::size_t up = upwards.axis;
  const std::size_t along = up == 0 ? 1 : 0;
  const std::size_t across = up == 2 ? 1 : 2;
  const double radius = view_radius(scene_);
  const double cell = round_length(radius / 6);
  std::array<double, 3> center = scene_.center();
  // A hair below what stands on it, so that flat feet do not flicker.
  center[up] = (upwards.sign > 0 ? scene_.low() : scene_.high())[up] - upwards.sign * 0.002 * radius;
  const auto phase = [&](std::size_t axis) {
    return static_cast<float>(std::remainder(center[axis] / cell, 10.0));
  };
  glUseProgram(program);
  glUniformMatrix4fv(place("view"), 1, GL_FALSE, matrices.view.data());
  glUniformMatrix4fv(place("projection"), 1, GL_FALSE, matrices.projection.data());
  glUniform3f(place("center"), static_cast<float>(center[0]), static_cast<float>(center[1]),
              static_cast<float>(center[2]));
  set_vector(place("along"), AxisDirection{along, 1});
  set_vector(place("across"), AxisDirection{across, 1});
  glUniform1f(place("reach"), static_cast<float>(4 * radius));
  glUniform1f(place("cell"), static_cast<float>(cell));
  glUniform2f(place("phase"), phase(along), phase(across));
  set_direction(place("ground_normal"), matrices, upwards);
  // Lines of a pixel weigh more in a small picture.
  const float strength = std::clamp(static_cast<float>(viewport.height) / 720, 0.35F, 1.0F);
  const bool dark = style.background_bottom.green < 0.45F;
  set_colour(place("ink"), dark ? cli::Colour{0.75F, 0.80F, 0.88F} : cli::Colour{0.22F, 0.25F, 0.31F});
  glUniform1f(place("strength"), (dark ? 0.20F : 0.26F) * strength);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glBindVertexArray(empty_array_.get());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

}  // namespace tvg::player
