#include "player/render/picture.hpp"

#include "player/view/axes_gizmo.hpp"

#include <algorithm>

#include <tvg/normals.hpp>

namespace tvg::player {

std::vector<Cell> sheet_cells(int width, int height, int columns, int rows) {
  std::vector<Cell> cells;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int x = width * column / columns;
      const int y = height * row / rows;
      cells.push_back({x, y, width * (column + 1) / columns - x, height * (row + 1) / rows - y});
    }
  }
  return cells;
}

PicturePainter::PicturePainter(int width, int height, const Style& style, bool labels, bool axes)
    : framebuffer_(width, height), style_(style), has_labels_(labels), has_axes_(axes) {
  if (labels || axes) text_.emplace(text_size(height));
}

void PicturePainter::set_scene(const BoundingBox& bounds, const OrbitCamera& camera) {
  shown_.renderer.set_scene(bounds, camera.orientation());
  reference_.renderer.set_scene(bounds, camera.orientation());
  camera_ = camera;
}

void PicturePainter::begin() {
  framebuffer_.bind();
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  if (text_) list_ = &text_->begin(framebuffer_.width(), framebuffer_.height());
}

void PicturePainter::draw(const ShownFrame& frame, Which which, cli::ColourMap map, const Cell& cell) {
  Subject& subject = which == Which::kShown ? shown_ : reference_;
  if (subject.mesh != frame.mesh) {
    subject.mesh = frame.mesh;
    subject.renderer.set_mesh(*frame.mesh, frame.surface);
    subject.normals.assign(3 * std::size_t{frame.mesh->vertex_count}, 0.0F);
  }
  if (style_.shading == Shading::kSmooth) {
    vertex_normals(frame.mesh->faces, frame.positions, subject.normals);
  }
  subject.renderer.set_frame(frame.positions, subject.normals, frame.values, map, frame.colours);
  subject.renderer.draw(camera_, style_, viewport(cell));
}

void PicturePainter::clear(const Cell& cell) {
  shown_.renderer.draw_background(style_, viewport(cell));
}

float PicturePainter::text_size_of(const Cell& cell) const {
  return std::min(text_size(framebuffer_.height()), text_size(2 * cell.height));
}

void PicturePainter::label(const Cell& cell, const std::string& text) {
  if (list_ == nullptr || !has_labels_) return;
  const float size = text_size_of(cell);
  draw_label(*list_,
             {static_cast<float>(cell.x) + 0.6F * size,
              static_cast<float>(cell.y + cell.height) - 2.1F * size, size},
             text);
}

void PicturePainter::legend(const Legend& legend, bool between) {
  if (list_ == nullptr || !has_labels_) return;
  const float size = text_size(framebuffer_.height());
  TextPlace place{size, size, size};
  if (between) {
    place.x = (static_cast<float>(framebuffer_.width()) - legend_extent(legend, size).width) / 2;
  }
  draw_legend(*list_, place, legend);
}

void PicturePainter::legend(const Legend& legend, const Cell& cell) {
  if (list_ == nullptr || !has_labels_) return;
  const float size = text_size(framebuffer_.height());
  draw_legend(*list_, {static_cast<float>(cell.x) + size, static_cast<float>(cell.y) + size, size}, legend);
}

void PicturePainter::axes(const Cell& cell) {
  if (list_ == nullptr || !has_axes_) return;
  const float size = text_size_of(cell);
  const float inwards = axes_reach(size) + 0.6F * size;
  draw_axes(*list_, camera_.axes(),
            {static_cast<float>(cell.x + cell.width) - inwards,
             static_cast<float>(cell.y + cell.height) - inwards, size},
            has_labels_);
}

void PicturePainter::pose(const Pose& pose, const Cell& cell) {
  if (list_ == nullptr || !has_labels_) return;
  const PictureArea area{static_cast<float>(cell.x), static_cast<float>(cell.y),
                         static_cast<float>(cell.width), static_cast<float>(cell.height)};
  draw_pose(*list_, camera_, area, pose, text_size(framebuffer_.height()));
}

const Image& PicturePainter::finish() {
  if (text_) text_->end();
  list_ = nullptr;
  framebuffer_.read(image_);
  return image_;
}

}  // namespace tvg::player
