#pragma once
#include "player/view/bounds.hpp"
#include "player/view/camera.hpp"
#include "player/view/gl_objects.hpp"
#include "player/view/surface.hpp"
#include "tool/colour_map.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>

#include <tvg/types.hpp>

namespace tvg::player {

enum class Shading { kSmooth, kFlat };

/// How a mesh is drawn.
struct Style {
  Shading shading = Shading::kSmooth;
  bool wireframe = false;
  bool grid = false;
  /// For machines that draw without a graphics card: where a mesh has many faces, a third of them is drawn.
  /// Flat shading and wireframe show every face all the same.
  bool draft = false;
  cli::Colour surface{0.84F, 0.70F, 0.60F};            ///< where no values colour it
  cli::Colour background_top{0.93F, 0.94F, 0.955F};    ///< at the picture's upper edge
  cli::Colour background_bottom{0.74F, 0.77F, 0.81F};  ///< at its lower edge
};

/// Draws one mesh whose vertices move. Needs an OpenGL 3.3 core context that is current in every call, the
/// destructor's included; it draws into whatever framebuffer is bound. The context's viewport and scissor
/// rectangle are changed; depth test, blending, scissor test, vertex array and program are off when draw()
/// returns. Errors of the driver are ToolErrors (kOther).
class MeshRenderer {
 public:
  MeshRenderer();

  /// The mesh of the frames that follow, and how it looks where no values colour it; null for one colour.
  /// Nothing is drawn until set_frame().
  void set_mesh(const Mesh& mesh, std::shared_ptr<const Surface> surface = nullptr);

  /// What the ground grid lies under and how wide it is: the box of all that will be shown, and how it
  /// stands.
  void set_scene(const BoundingBox& bounds, const Orientation& orientation);

  /// The frame to draw. `positions` and `normals`: [vertex][xyz]; a normal of length 0 takes that of its
  /// face. `normals` may be empty, which draws flat. `values`: [vertex], 0 to 1, the colour of each vertex by
  /// `map`, or empty for the style's colour. All are copied to the driver at once; no memory is allocated
  /// here.
  /// `colours`: as SurfaceFrame::set() has them.
  void set_frame(std::span<const float> positions, std::span<const float> normals,
                 std::span<const float> values = {}, cli::ColourMap map = cli::ColourMap::kViridis,
                 std::span<const float> colours = {});

  /// Draws background, mesh and grid; what was in the viewport before is gone.
  void draw(const OrbitCamera& camera, const Style& style, const Viewport& viewport);
  /// Draws the background alone.
  void draw_background(const Style& style, const Viewport& viewport);

 private:
  struct MeshProgram {
    GlProgram program;
    GLint view = -1;
    GLint projection = -1;
    GLint up = -1;
    GLint surface = -1;
    GLint half_viewport = -1;
    GLint point_size = -1;
    GLint factor = -1;
    GLint cutoff = -1;
    GLint textured = -1;
  };

  const MeshProgram& mesh_program(const Style& style);
  void draw_mesh(const CameraMatrices& matrices, const Style& style, const Viewport& viewport);
  void draw_grid(const CameraMatrices& matrices, const Style& style, const Viewport& viewport);
  void set_surface(std::shared_ptr<const Surface> surface);
  void draw_faces(const Style& style);
  void draw_runs(const MeshProgram& program, const Style& style);
  void use_material(const MeshProgram& program, const ShownMaterial& material);
  void use_colour_map(cli::ColourMap map);

  GlVertexArray mesh_array_, empty_array_;
  GlBuffer positions_, normals_, values_, faces_, draft_faces_, surface_faces_, vertex_colours_, texcoords_;
  GlTexture colours_;
  GlProgram background_, grid_;
  std::array<MeshProgram, 32> programs_;  // by what they do, made when first used
  std::uint32_t vertex_count_ = 0;
  std::size_t face_count_ = 0;
  std::size_t draft_face_count_ = 0;  // 0: there are not so many faces
  std::shared_ptr<const Surface> surface_;
  SurfaceFrame surface_frame_;
  std::map<const Image*, GlTexture> pictures_;  // of the surface's materials
  bool shows_surface_ = false;                  // the frame is drawn by surface_
  bool has_frame_ = false;
  bool has_normals_ = false;
  bool has_values_ = false;
  int colours_shown_ = -1;  // the map in colours_
  BoundingBox scene_;
  Orientation orientation_;
};

}  // namespace tvg::player
