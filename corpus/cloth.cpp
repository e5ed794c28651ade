#include "corpus/corpus.hpp"
#include "corpus/exact_math.hpp"
#include "corpus/surface.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

// The flag: masses on a grid, held at a pole, blown by wind; springs are position constraints. The simulation
// always has the same grid; the mesh samples a cubic B-spline through it, so that every size shows the same
// motion. Units: m.
namespace tvg::corpus {
namespace {

constexpr std::uint32_t kColumns = 41;
constexpr std::uint32_t kRows = 28;
constexpr double kSpacing = 1.5 / (kColumns - 1);
constexpr int kStepsPerFrame = 4;
constexpr double kStep = 1.0 / 30 / kStepsPerFrame;  // seconds
constexpr int kRelaxations = 8;
constexpr int kSettlingFrames = 45;

struct Spring {
  std::uint32_t a, b;
  double rest;
  double stiffness;  ///< share of the stretch that one relaxation takes back
};

class FlagSimulation {
 public:
  FlagSimulation() {
    for (std::uint32_t row = 0; row < kRows; ++row) {
      for (std::uint32_t column = 0; column < kColumns; ++column) {
        // A slight curve at the start breaks the symmetry of a flat cloth in parallel wind.
        const double x = column * kSpacing;
        points_.push_back({x, row * kSpacing, 0.03 * sine(x + 0.3 * row * kSpacing)});
      }
    }
    previous_ = points_;
    for (std::uint32_t row = 0; row < kRows; ++row) {
      for (std::uint32_t column = 0; column < kColumns; ++column) add_springs(row, column);
    }
  }

  /// [row][column]
  const std::vector<Vec3>& points() const { return points_; }

  void advance_frame() {
    for (int step = 0; step < kStepsPerFrame; ++step) advance();
  }

 private:
  static std::uint32_t at(std::uint32_t row, std::uint32_t column) { return row * kColumns + column; }

  void add_spring(std::uint32_t a, std::uint32_t b, double stiffness) {
    springs_.push_back({a, b, length(points_[a] - points_[b]), stiffness});
  }

  void add_springs(std::uint32_t row, std::uint32_t column) {
    const std::uint32_t here = at(row, column);
    if (column + 1 < kColumns) add_spring(here, at(row, column + 1), 0.9);
    if (row + 1 < kRows) add_spring(here, at(row + 1, column), 0.9);
    if (row + 1 < kRows && column + 1 < kColumns) {
      add_spring(here, at(row + 1, column + 1), 0.4);
      add_spring(at(row, column + 1), at(row + 1, column), 0.4);
    }
    if (column + 2 < kColumns) add_spring(here, at(row, column + 2), 0.08);
    if (row + 2 < kRows) add_spring(here, at(row + 2, column), 0.08);
  }

  Vec3 wind(const Vec3& p) const {
    const double gust = 0.75 + 0.25 * sine(0.37 * seconds_) * sine(0.11 * seconds_ + 0.2);
    return {7.5 * gust, 0.5 * sine(0.9 * seconds_ - 0.6 * p.x),
            2.4 * sine(0.8 * seconds_ - 0.9 * p.x + 0.2 * p.y) +
                1.1 * sine(1.7 * seconds_ - 1.6 * p.x - 0.7 * p.y)};
  }

  /// Acceleration by gravity and by the air that meets the cloth head on.
  Vec3 acceleration(std::uint32_t row, std::uint32_t column) const {
    const std::uint32_t here = at(row, column);
    const Vec3 along = points_[at(row, std::min(column + 1, kColumns - 1))] - points_[at(row, column - 1)];
    const Vec3 up =
        points_[at(std::min(row + 1, kRows - 1), column)] - points_[at(row == 0 ? 0 : row - 1, column)];
    const Vec3 normal = cross(along, up);
    const double size = length(normal);
    Vec3 sum{0, -9.81, 0};
    if (size > 0) {
      const Vec3 velocity = 1 / kStep * (points_[here] - previous_[here]);
      const double head_on = dot(wind(points_[here]) - velocity, normal) / size;
      sum = sum + 9.0 * head_on / size * normal;
    }
    return sum;
  }

  void advance() {
    std::vector<Vec3> next = points_;
    for (std::uint32_t row = 0; row < kRows; ++row) {
      for (std::uint32_t column = 1; column < kColumns; ++column) {
        const std::uint32_t here = at(row, column);
        next[here] = points_[here] + 0.995 * (points_[here] - previous_[here]) +
                     kStep * kStep * acceleration(row, column);
      }
    }
    previous_ = std::exchange(points_, std::move(next));
    for (int k = 0; k < kRelaxations; ++k) relax();
    seconds_ += kStep;
  }

  void relax() {
    for (const Spring& spring : springs_) {
      const Vec3 between = points_[spring.b] - points_[spring.a];
      const double now = length(between);
      if (now == 0) continue;
      const Vec3 change = spring.stiffness * (now - spring.rest) / now * between;
      const bool a_held = spring.a % kColumns == 0;
      const bool b_held = spring.b % kColumns == 0;
      if (a_held && b_held) continue;
      if (!a_held) points_[spring.a] = points_[spring.a] + (b_held ? 1.0 : 0.5) * change;
      if (!b_held) points_[spring.b] = points_[spring.b] - (a_held ? 1.0 : 0.5) * change;
    }
  }

  std::vector<Vec3> points_, previous_;
  std::vector<Spring> springs_;
  double seconds_ = 0;
};

/// Uniform cubic B-spline at `t` in [0, last], over the control points get(0..last); past the ends the
/// control polygon goes on straight, so that the curve reaches its first and last point.
template <class Get>
Vec3 spline(double t, int last, const Get& get) {
  const int cell = std::min(static_cast<int>(t), last - 1);
  const double s = t - cell;
  const double r = 1 - s;
  const std::array<double, 4> weights = {r * r * r / 6, (3 * s * s * s - 6 * s * s + 4) / 6,
                                         (3 * r * r * r - 6 * r * r + 4) / 6, s * s * s / 6};
  const auto control = [&](int i) {
    if (i < 0) return 2.0 * get(0) - get(1);
    if (i > last) return 2.0 * get(last) - get(last - 1);
    return get(i);
  };
  Vec3 sum;
  for (int k = 0; k < 4; ++k) sum = sum + weights[static_cast<std::size_t>(k)] * control(cell - 1 + k);
  return sum;
}

/// The simulated grid sampled at columns x rows points, [row][column].
std::vector<Vec3> resample(const std::vector<Vec3>& grid, std::uint32_t columns, std::uint32_t rows) {
  std::vector<Vec3> points;
  points.reserve(std::size_t{columns} * rows);
  std::vector<Vec3> line(kColumns);
  for (std::uint32_t row = 0; row < rows; ++row) {
    const double v = static_cast<double>(row) / (rows - 1) * (kRows - 1);
    for (std::uint32_t i = 0; i < kColumns; ++i) {
      line[i] =
          spline(v, kRows - 1, [&](int j) { return grid[static_cast<std::uint32_t>(j) * kColumns + i]; });
    }
    for (std::uint32_t column = 0; column < columns; ++column) {
      const double u = static_cast<double>(column) / (columns - 1) * (kColumns - 1);
      points.push_back(spline(u, kColumns - 1, [&](int i) { return line[static_cast<std::size_t>(i)]; }));
    }
  }
  return points;
}

}  // namespace

Sequence make_cloth(const SequenceSize& size) {
  const auto rows = static_cast<std::uint32_t>(std::max(8.0, std::sqrt(size.vertices / 1.5) + 0.5));
  const auto columns = static_cast<std::uint32_t>(std::lround(rows * 1.5));
  Surface surface;
  for (std::uint32_t row = 0; row + 1 < rows; ++row) {
    for (std::uint32_t column = 0; column + 1 < columns; ++column) {
      const std::uint32_t a = row * columns + column;
      surface.add_quad(a, a + 1, a + 1 + columns, a + columns);
    }
  }
  Sequence cloth;
  cloth.mesh = {columns * rows, std::move(surface.faces)};
  FlagSimulation simulation;
  for (int frame = 0; frame < kSettlingFrames; ++frame) simulation.advance_frame();
  for (std::uint32_t frame = 0; frame < size.frames; ++frame) {
    cloth.frames.push_back(to_frame(resample(simulation.points(), columns, rows)));
    simulation.advance_frame();
  }
  cloth.metadata = {{"name", "cloth"}, {"fps", "30"}, {"units", "m"}, {"up", "y"}};
  return cloth;
}

}  // namespace tvg::corpus
