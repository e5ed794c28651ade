#pragma once
#include "player/frames/shown_frames.hpp"
#include "player/view/framebuffer.hpp"
#include "player/view/joint_overlay.hpp"
#include "player/view/mesh_renderer.hpp"
#include "player/view/offscreen_context.hpp"
#include "player/view/text_layer.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tvg::player {

/// A part of a picture, in pixels from its upper left corner.
struct Cell {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// The cells of a sheet, row by row; together they fill the picture.
std::vector<Cell> sheet_cells(int width, int height, int columns, int rows);

/// Draws pictures of frames without a display. begin(), draw() for each cell, finish().
class PicturePainter {
 public:
  /// Size in pixels. With `labels`, text is drawn. Throws ToolError where this machine cannot draw.
  PicturePainter(int width, int height, const Style& style, bool labels, bool axes = false);

  /// Smooth or flat, from the next picture on.
  void set_shading(Shading shading) { style_.shading = shading; }
  /// One colour behind everything, from the next picture on.
  void set_background(const cli::Colour& colour) {
    style_.background_top = style_.background_bottom = colour;
  }
  /// What all pictures show, and from where.
  void set_scene(const BoundingBox& bounds, const OrbitCamera& camera);

  /// Two meshes can be drawn in turn without their being sent to the driver anew each time.
  enum class Which { kShown, kReference };

  void begin();
  /// Draws a frame into a cell. Its values, where it has any, are colours by `map`, 0 to 1.
  void draw(const ShownFrame& frame, Which which, cli::ColourMap map, const Cell& cell);
  /// Leaves a cell with nothing but the background.
  void clear(const Cell& cell);
  /// Text in the lower left corner of a cell.
  void label(const Cell& cell, const std::string& text);
  /// The legend in the upper left corner of the picture, or between two cells side by side.
  void legend(const Legend& legend, bool between);
  /// A legend of its own in the upper left corner of a cell.
  void legend(const Legend& legend, const Cell& cell);
  /// Which way x, y and z go, in the lower right corner of a cell, where the constructor was told so.
  void axes(const Cell& cell);
  /// A skeleton over what was drawn into a cell.
  void pose(const Pose& pose, const Cell& cell);
  /// The picture, valid until the next begin().
  const Image& finish();

 private:
  Viewport viewport(const Cell& cell) const {
    return {cell.x, framebuffer_.height() - cell.y - cell.height, cell.width, cell.height};
  }

  float text_size_of(const Cell& cell) const;

  struct Subject {
    MeshRenderer renderer;
    std::shared_ptr<const Mesh> mesh;
    std::vector<float> normals;
  };

  OffscreenContext context_;
  Framebuffer framebuffer_;
  Style style_;
  Subject shown_, reference_;
  bool has_labels_;
  bool has_axes_;
  std::optional<TextLayer> text_;
  ImDrawList* list_ = nullptr;  // of what goes over the picture; null where nothing does
  OrbitCamera camera_;
  Image image_;
};

}  // namespace tvg::player
