#include "base/errors.hpp"
#include "metrics/frame_checks.hpp"
#include "metrics/surface_index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <tvg/geometry.hpp>
#include <tvg/metrics.hpp>

namespace tvg {
namespace {

using Eigen::Vector3d;

/// Points of a surface, each for the same share of its area. Of a surface without area, each for a face.
Points spread(std::span<const Face> faces, const Points& points, std::uint32_t count) {
  std::vector<double> area_up_to;  // [face]
  area_up_to.reserve(faces.size());
  double area = 0;
  for (const auto& [a, b, c] : faces) {
    area += (points[b] - points[a]).cross(points[c] - points[a]).norm();
    area_up_to.push_back(area);
  }
  if (area == 0) {
    for (double& each : area_up_to) each = ++area;
  }
  // The places within faces are those of an additive recurrence over two numbers that go round evenly.
  constexpr double kAcross = 0.7548776662466927, kAlong = 0.5698402909980532;
  Points samples;
  samples.reserve(count);
  std::size_t face = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double place = (i + 0.5) / count * area;
    while (face + 1 < faces.size() && area_up_to[face] <= place) ++face;
    double u = 0.5 + i * kAcross, v = 0.5 + i * kAlong;
    u -= std::floor(u);
    v -= std::floor(v);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const auto& [a, b, c] = faces[face];
    samples.emplace_back(points[a] + u * (points[b] - points[a]) + v * (points[c] - points[a]));
  }
  return samples;
}

struct Distances {
  double mean_square = 0;
  double largest = 0;  ///< over all points
};

/// How far points are from a surface: `samples` count for both figures, `others` for the largest alone.
Distances distances_to(const SurfaceIndex& surface, const Points& samples, const Points& others) {
  Distances result;
  // Points that follow each other are near each other, and no point is farther than its neighbour is, and the
  // way there.
  const Vector3d* last = nullptr;
  double distance = std::numeric_limits<double>::infinity();
  const auto next = [&](const Vector3d& point) {
    if (last != nullptr) distance += (point - *last).norm();
    distance = surface.distance(point, distance);
    last = &point;
    result.largest = std::max(result.largest, distance);
    return distance;
  };
  double sum = 0;
  for (const Vector3d& sample : samples) {
    const double off = next(sample);
    sum += off * off;
  }
  for (const Vector3d& point : others) next(point);
  result.mean_square = sum / static_cast<double>(samples.size());
  return result;
}

/// A mesh and what of it is there once.
struct Side {
  explicit Side(const Mesh& of) : mesh(of), valid(faces_are_valid(of)), in_use(of.vertex_count, false) {
    if (!valid) return;
    for (const Face& face : mesh.faces) {
      for (const std::uint32_t v : face) in_use[v] = true;
    }
  }

  Points used() const {
    Points result;
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (in_use[v]) result.push_back(points[v]);
    }
    return result;
  }

  Mesh mesh;
  bool valid;
  std::vector<bool> in_use;  ///< [vertex]
  Points points;             ///< of the present frame
};

}  // namespace

class SurfaceComparison::Accumulator {
 public:
  Accumulator(const Mesh& original, const Mesh& other, const SurfaceSettings& settings)
      : original_(original), other_(other), settings_(settings) {}

  void set_original(const Mesh& original) { original_ = Side(original); }
  void set_other(const Mesh& other) { other_ = Side(other); }
  bool measures_next() const { return settings_.stride != 0 && frames_ % settings_.stride == 0; }

  Status add_frame(std::span<const float> original, std::span<const float> other) {
    Status checked = check(original, other);
    if (!checked.ok()) return at_frame(frames_, checked.error());
    if (shows_nothing()) {
      ++frames_;
      return {};
    }
    box_.extend(original);
    if (measures_next()) {
      load_points(original, original_.points);
      load_points(other, other_.points);
      measure();
    }
    ++frames_;
    return {};
  }

  SurfaceReport report() const;

 private:
  Status check(std::span<const float> original, std::span<const float> other) const {
    if (settings_.stride == 0 || settings_.samples == 0)
      return invalid_argument("samples and stride of a comparison of surfaces must be at least 1");
    for (const Side* side : {&original_, &other_}) {
      if (!side->valid) return invalid_input("a face of the mesh names a vertex that does not exist");
      if (side->mesh.faces.empty() && !shows_nothing())
        return invalid_input("a mesh without faces has no surface");
    }
    Status checked = check_positions(original_.mesh, original, "original");
    return checked.ok() ? check_positions(other_.mesh, other, "other") : checked;
  }

  bool shows_nothing() const { return original_.mesh.faces.empty() && other_.mesh.faces.empty(); }

  void measure() {
    const auto directed = [this](const Side& from, const Side& to) {
      return distances_to(SurfaceIndex(to.mesh.faces, to.points),
                          spread(from.mesh.faces, from.points, settings_.samples), from.used());
    };
    const Distances there = directed(original_, other_);
    const Distances back = directed(other_, original_);
    sum_there_ += there.mean_square;
    sum_back_ += back.mean_square;
    measured_.push_back(
        {frames_, std::sqrt(there.mean_square), std::sqrt(back.mean_square), there.largest, back.largest});
  }

  Side original_, other_;
  SurfaceSettings settings_;
  std::uint64_t frames_ = 0;
  double sum_there_ = 0, sum_back_ = 0;  ///< mean squares of the frames
  BoundingBox box_;
  std::vector<SurfaceDistances> measured_;
};

SurfaceReport SurfaceComparison::Accumulator::report() const {
  SurfaceReport report;
  report.frames = frames_;
  report.original_vertices = original_.mesh.vertex_count;
  report.other_vertices = other_.mesh.vertex_count;
  report.original_faces = original_.mesh.faces.size();
  report.other_faces = other_.mesh.faces.size();
  report.diagonal = box_.diagonal();
  report.measured = measured_;
  if (measured_.empty()) return report;
  const auto frames = static_cast<double>(measured_.size());
  report.rms = std::sqrt(std::max(sum_there_, sum_back_) / frames);
  for (const SurfaceDistances& frame : measured_) {
    report.mean_hausdorff += frame.hausdorff() / frames;
    if (frame.hausdorff() > report.hausdorff) {
      report.hausdorff = frame.hausdorff();
      report.worst_hausdorff_frame = frame.frame;
    }
    if (frame.rms() > report.worst_rms) {
      report.worst_rms = frame.rms();
      report.worst_rms_frame = frame.frame;
    }
  }
  report.relative_rms = share(report.rms, report.diagonal);
  report.relative_worst_rms = share(report.worst_rms, report.diagonal);
  report.relative_mean_hausdorff = share(report.mean_hausdorff, report.diagonal);
  report.relative_hausdorff = share(report.hausdorff, report.diagonal);
  return report;
}

SurfaceComparison::SurfaceComparison(const Mesh& original, const Mesh& other, const SurfaceSettings& settings)
    : accumulator_(std::make_unique<Accumulator>(original, other, settings)) {}
SurfaceComparison::~SurfaceComparison() = default;
SurfaceComparison::SurfaceComparison(SurfaceComparison&&) noexcept = default;
SurfaceComparison& SurfaceComparison::operator=(SurfaceComparison&&) noexcept = default;

void SurfaceComparison::set_original(const Mesh& original) {
  accumulator_->set_original(original);
}

void SurfaceComparison::set_other(const Mesh& other) {
  accumulator_->set_other(other);
}

Status SurfaceComparison::add_frame(std::span<const float> original, std::span<const float> other) {
  return accumulator_->add_frame(original, other);
}

bool SurfaceComparison::measures_next() const {
  return accumulator_->measures_next();
}

SurfaceReport SurfaceComparison::report() const {
  return accumulator_->report();
}

}  // namespace tvg
