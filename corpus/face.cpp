#include "corpus/corpus.hpp"
#include "corpus/exact_math.hpp"
#include "corpus/surface.hpp"

#include <array>
#include <cmath>
#include <vector>

// The face: a grid bent to an oval mask, cut open at mouth and eyes; features are bells added to it. Units:
// cm. Feature coordinates (x, y) are those of the oval scaled to the unit disc.
namespace tvg::corpus {
namespace {

constexpr double kHalfWidth = 7.5;
constexpr double kHalfHeight = 10.5;

/// A cut along a row of the grid.
struct Slit {
  double x, y;  ///< its middle
  double half_width;
  double reach_up, reach_down;      ///< how far above and below the skin follows
  double opening_up, opening_down;  ///< how far the lids or lips part when fully open, in cm
};

constexpr Slit kMouth{0, -0.42, 0.30, 0.20, 0.45, 0.35, 1.9};
constexpr std::array<Slit, 3> kSlits = {kMouth, Slit{-0.36, 0.20, 0.17, 0.17, 0.12, 0.75, 0.3},
                                        Slit{0.36, 0.20, 0.17, 0.17, 0.12, 0.75, 0.3}};

enum class Side { kAbove, kBelow };

struct MaskVertex {
  double x = 0, y = 0;
  Side of_mouth = Side::kAbove;
  Side of_eyes = Side::kAbove;
};

/// Expression at a time: each in [0, 1].
struct Expression {
  double mouth_open = 0;
  double eyes_open = 1;
  double brows_up = 0;
};

Expression expression_at(double seconds) {
  Expression expression;
  const double syllable = 0.5 - 0.5 * cosine(1.7 * seconds);
  const double phrase = 0.55 - 0.45 * cosine(0.4 * seconds + 0.2);
  expression.mouth_open = syllable * phrase * (0.85 + 0.15 * sine(3.1 * seconds));
  const double since_blink = seconds - 1.9 * std::floor(seconds / 1.9);
  expression.eyes_open = 1 - bell((since_blink - 0.35) / 0.17);
  const double since_brows = seconds - 2.7 * std::floor(seconds / 2.7);
  expression.brows_up = bell((since_brows - 0.9) / 0.6);
  return expression;
}

/// A bell of two variables with elliptic support.
double spot(double x, double y, double centre_x, double centre_y, double radius_x, double radius_y) {
  const double u = (x - centre_x) / radius_x;
  const double v = (y - centre_y) / radius_y;
  const double rest = 1 - u * u - v * v;
  return rest > 0 ? rest * rest : 0.0;
}

/// Depth of the mask at rest, in cm.
double depth(double x, double y) {
  double z = 9 * std::sqrt(1 - 0.75 * (x * x + y * y)) - 5;
  z += 2.6 * spot(x, y, 0, -0.10, 0.20, 0.32) + 0.9 * spot(x, y, 0, 0.12, 0.14, 0.36);
  z += 0.9 * spot(x, y, 0, -0.42, 0.42, 0.17) + 0.8 * spot(x, y, 0, -0.82, 0.35, 0.25);
  for (const double side : {-1.0, 1.0}) {
    z -= 1.0 * spot(x, y, side * 0.36, 0.22, 0.27, 0.22);
    z += 0.45 * spot(x, y, side * 0.36, 0.20, 0.18, 0.14);
    z += 0.7 * spot(x, y, side * 0.36, 0.42, 0.34, 0.13);
    z += 0.6 * spot(x, y, side * 0.48, -0.12, 0.30, 0.28);
  }
  return z;
}

/// How far an opening of `share` moves a point up (negative: down), in cm.
double slit_shift(const Slit& slit, double x, double y, Side side, double share) {
  const double across = bell((x - slit.x) / slit.half_width);
  // Above and below count from the slit's own row, which the oval bends a little.
  if (side == Side::kAbove)
    return share * slit.opening_up * across * bell(std::max(0.0, y - slit.y) / slit.reach_up);
  return -share * slit.opening_down * across * bell(std::max(0.0, slit.y - y) / slit.reach_down);
}

Vec3 place(const MaskVertex& vertex, const Expression& expression) {
  const double x = vertex.x;
  const double y = vertex.y;
  Vec3 p{kHalfWidth * x, kHalfHeight * y, depth(x, y)};
  const double mouth = slit_shift(kMouth, x, y, vertex.of_mouth, expression.mouth_open);
  p.y += mouth;
  p.z -= 0.12 * mouth * mouth;
  for (const Slit& eye : {kSlits[1], kSlits[2]})
    p.y += slit_shift(eye, x, y, vertex.of_eyes, expression.eyes_open);
  for (const double side : {-1.0, 1.0}) {
    const double brow = expression.brows_up * spot(x, y, side * 0.36, 0.48, 0.36, 0.20);
    p.y += 0.75 * brow;
    p.z += 0.25 * brow;
  }
  return p;
}

/// The grid before it moves, and its triangles.
struct Mask {
  std::vector<MaskVertex> vertices;
  std::vector<Face> faces;
};

class MaskBuilder {
 public:
  MaskBuilder(std::uint32_t columns, std::uint32_t rows) : columns_(columns), rows_(rows) {
    mouth_row_ = row_of(kMouth.y);
    eye_row_ = row_of(kSlits[1].y);
  }

  Mask build() {
    for (std::uint32_t row = 0; row < rows_; ++row) {
      for (std::uint32_t column = 0; column < columns_; ++column) {
        mask_.vertices.push_back(grid_vertex(row, column));
      }
    }
    // The grid's own vertices along a slit are its upper edge; the lower edge gets new ones.
    lower_.resize(mask_.vertices.size());
    for (std::uint32_t v = 0; v < lower_.size(); ++v) lower_[v] = v;
    for (const Slit& slit : kSlits) cut(slit);
    for (std::uint32_t row = 0; row + 1 < rows_; ++row) {
      for (std::uint32_t column = 0; column + 1 < columns_; ++column) add_cell(row, column);
    }
    return std::move(mask_);
  }

 private:
  std::uint32_t row_of(double y) const {
    return static_cast<std::uint32_t>(std::lround((y + 1) / 2 * (rows_ - 1)));
  }

  MaskVertex grid_vertex(std::uint32_t row, std::uint32_t column) const {
    const double u = 2.0 * column / (columns_ - 1) - 1;
    const double v = 2.0 * row / (rows_ - 1) - 1;
    MaskVertex vertex{u * std::sqrt(1 - v * v / 2), v * std::sqrt(1 - u * u / 2), Side::kAbove, Side::kAbove};
    vertex.of_mouth = row < mouth_row_ ? Side::kBelow : Side::kAbove;
    vertex.of_eyes = row < eye_row_ ? Side::kBelow : Side::kAbove;
    return vertex;
  }

  void cut(const Slit& slit) {
    const bool is_mouth = slit.y < 0;
    const std::uint32_t row = is_mouth ? mouth_row_ : eye_row_;
    for (std::uint32_t column = 0; column < columns_; ++column) {
      const std::uint32_t upper = row * columns_ + column;
      MaskVertex vertex = mask_.vertices[upper];
      const double from_middle = vertex.x - slit.x;
      if (from_middle >= slit.half_width || from_middle <= -slit.half_width) continue;
      (is_mouth ? vertex.of_mouth : vertex.of_eyes) = Side::kBelow;
      lower_[upper] = static_cast<std::uint32_t>(mask_.vertices.size());
      mask_.vertices.push_back(vertex);
    }
  }

  void add_cell(std::uint32_t row, std::uint32_t column) {
    const std::uint32_t a = row * columns_ + column;
    const std::uint32_t b = a + 1;
    // The upper side of a cell is the lower edge of a slit that runs there.
    const std::uint32_t c = lower_[b + columns_];
    const std::uint32_t d = lower_[a + columns_];
    if ((row + column) % 2 == 0) {
      mask_.faces.push_back({a, b, c});
      mask_.faces.push_back({a, c, d});
    } else {
      mask_.faces.push_back({a, b, d});
      mask_.faces.push_back({b, c, d});
    }
  }

  std::uint32_t columns_, rows_, mouth_row_, eye_row_;
  Mask mask_;
  std::vector<std::uint32_t> lower_;  ///< [grid vertex]: the vertex that faces below it use
};

}  // namespace

Sequence make_face(const SequenceSize& size) {
  const auto columns = static_cast<std::uint32_t>(std::max(16.0, std::sqrt(size.vertices / 1.3) + 0.5));
  const auto rows = static_cast<std::uint32_t>(std::lround(columns * 1.3));
  const Mask mask = MaskBuilder(columns, rows).build();
  Sequence face;
  face.mesh = {static_cast<std::uint32_t>(mask.vertices.size()), mask.faces};
  std::vector<Vec3> points(mask.vertices.size());
  for (std::uint32_t frame = 0; frame < size.frames; ++frame) {
    const Expression expression = expression_at(frame / 30.0);
    for (std::size_t v = 0; v < points.size(); ++v) points[v] = place(mask.vertices[v], expression);
    face.frames.push_back(to_frame(points));
  }
  face.metadata = {{"name", "face"}, {"fps", "30"}, {"units", "cm"}, {"up", "y"}};
  return face;
}

}  // namespace tvg::corpus
