#include "base/errors.hpp"
#include "metrics/frame_checks.hpp"
#include "metrics/hausdorff.hpp"
#include "metrics/sted.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <tvg/geometry.hpp>
#include <tvg/metrics.hpp>

namespace tvg {
using Eigen::Vector3d;

class SequenceComparison::Accumulator {
 public:
  Accumulator(const Mesh& mesh, const ComparisonSettings& settings)
      : mesh_(mesh),
        settings_(settings),
        mesh_is_valid_(faces_are_valid(mesh)),
        original_(mesh.vertex_count),
        decoded_(mesh.vertex_count),
        quadric_(mesh.vertex_count) {}

  Status add_frame(std::span<const float> original, std::span<const float> decoded) {
    Status checked = check(original, decoded);
    if (!checked.ok()) return checked;
    box_.extend(original);
    load_points(original, original_);
    load_points(decoded, decoded_);
    add_distances();
    add_spread();
    add_quadrics();
    if (!edges_) edges_.emplace(mesh_);
    edges_->add_frame(original_, decoded_);
    if (settings_.hausdorff && !mesh_.faces.empty() && frames_ % settings_.hausdorff_stride == 0)
      add_hausdorff();
    ++frames_;
    return {};
  }

  ComparisonReport report() const;

 private:
  Status check(std::span<const float> original, std::span<const float> decoded) const {
    if (settings_.hausdorff_stride == 0) {
      return at_frame(frames_, invalid_argument("the stride of the Hausdorff distance must be at least 1"));
    }
    if (!mesh_is_valid_) {
      return at_frame(frames_, invalid_input("a face of the mesh names a vertex that does not exist"));
    }
    for (const auto& [frame, name] :
         {std::pair(original, "original"), std::pair(decoded, "decoded frames")}) {
      if (Status checked = check_positions(mesh_, frame, name); !checked.ok())
        return at_frame(frames_, checked.error());
    }
    return {};
  }

  void add_distances() {
    for (std::uint32_t v = 0; v < mesh_.vertex_count; ++v) {
      const Vector3d difference = (original_[v] - decoded_[v]).cwiseAbs();
      const double squared = difference.squaredNorm();
      sum_absolute_ += difference.sum();
      sum_squared_ += squared;
      max_coordinate_ = std::max(max_coordinate_, difference.maxCoeff());
      if (squared > max_squared_) {
        max_squared_ = squared;
        worst_frame_ = frames_;
        worst_vertex_ = v;
      }
    }
  }

  void add_spread() {
    Vector3d mean = Vector3d::Zero();
    for (const Vector3d& point : original_) mean += point / static_cast<double>(original_.size());
    for (const Vector3d& point : original_) spread_ += (point - mean).squaredNorm();
  }

  void add_quadrics() {
    std::fill(quadric_.begin(), quadric_.end(), 0.0);
    for (const auto& [a, b, c] : mesh_.faces) {
      Vector3d normal = (original_[b] - original_[a]).cross(original_[c] - original_[a]);
      const double size = normal.norm();
      if (!(size > 0)) continue;
      normal /= size;
      for (const std::uint32_t v : {a, b, c}) {
        // The original vertex lies in the plane itself, so its displacement has the wanted distance, and is
        // small.
        const double distance = normal.dot(decoded_[v] - original_[v]);
        quadric_[v] += distance * distance;
      }
    }
    for (const double error : quadric_) {
      sum_quadric_ += error;
      max_quadric_ = std::max(max_quadric_, error);
    }
  }

  void add_hausdorff() {
    forward_ = std::max(forward_, directed_hausdorff(mesh_.faces, original_, decoded_));
    backward_ = std::max(backward_, directed_hausdorff(mesh_.faces, decoded_, original_));
    ++hausdorff_frames_;
  }

  double signal_to_noise(double mean_error, double extent) const {
    // With a lattice of B bits over the longest side, step = extent / 2^B, and an error of e is e / step
    // lattice units. So 2^B / (mean e / step) = 2^B (extent / 2^B) / mean e = extent / mean e: B cancels.
    if (mean_error == 0) return std::numeric_limits<double>::infinity();
    return 20 * std::log10(extent / mean_error);
  }

  Mesh mesh_;
  ComparisonSettings settings_;
  bool mesh_is_valid_;
  Points original_, decoded_;            ///< the present frame
  std::vector<double> quadric_;          ///< [vertex], of the present frame
  std::optional<EdgeDifference> edges_;  ///< made when the mesh has been found valid

  std::uint64_t frames_ = 0;
  double sum_absolute_ = 0, sum_squared_ = 0;
  double max_coordinate_ = 0, max_squared_ = 0;
  std::uint64_t worst_frame_ = 0;
  std::uint32_t worst_vertex_ = 0;
  double spread_ = 0;  ///< sum of squared distances from the frame's centroid
  double sum_quadric_ = 0, max_quadric_ = 0;
  double forward_ = 0, backward_ = 0;
  std::uint64_t hausdorff_frames_ = 0;
  BoundingBox box_;
};

ComparisonReport SequenceComparison::Accumulator::report() const {
  ComparisonReport report;
  report.frames = frames_;
  report.vertices = mesh_.vertex_count;
  report.snr_db = std::numeric_limits<double>::infinity();
  const double points = static_cast<double>(frames_) * mesh_.vertex_count;
  if (points == 0) return report;

  report.extent = box_.largest_extent();
  report.diagonal = box_.diagonal();
  report.max_coordinate_error = max_coordinate_;
  report.max_vertex_distance = std::sqrt(max_squared_);
  report.rms_coordinate_error = std::sqrt(sum_squared_ / (3 * points));
  report.rms_vertex_distance = std::sqrt(sum_squared_ / points);
  report.mean_coordinate_error = sum_absolute_ / (3 * points);
  report.relative_max_coordinate_error = share(report.max_coordinate_error, report.diagonal);
  report.relative_max_vertex_distance = share(report.max_vertex_distance, report.diagonal);
  report.relative_rms_coordinate_error = share(report.rms_coordinate_error, report.diagonal);
  report.relative_rms_vertex_distance = share(report.rms_vertex_distance, report.diagonal);
  report.worst_frame = worst_frame_;
  report.worst_vertex = worst_vertex_;
  report.snr_db = signal_to_noise(report.mean_coordinate_error, report.extent);
  report.kg_percent = 100 * share(std::sqrt(sum_squared_), std::sqrt(spread_));
  report.mean_quadric_error = sum_quadric_ / points;
  report.max_quadric_error = max_quadric_;
  report.sted = edges_->combined();
  report.sted_spatial = edges_->spatial();
  report.sted_temporal = edges_->temporal();
  report.hausdorff_frames = hausdorff_frames_;
  if (hausdorff_frames_ > 0) {
    report.hausdorff = std::max(forward_, backward_);
    report.relative_hausdorff = share(*report.hausdorff, report.diagonal);
    report.hausdorff_original_to_decoded = forward_;
    report.hausdorff_decoded_to_original = backward_;
  }
  return report;
}

SequenceComparison::SequenceComparison(const Mesh& mesh, const ComparisonSettings& settings)
    : accumulator_(std::make_unique<Accumulator>(mesh, settings)) {}
SequenceComparison::~SequenceComparison() = default;
SequenceComparison::SequenceComparison(SequenceComparison&&) noexcept = default;
SequenceComparison& SequenceComparison::operator=(SequenceComparison&&) noexcept = default;

Status SequenceComparison::add_frame(std::span<const float> original, std::span<const float> decoded) {
  return accumulator_->add_frame(original, decoded);
}

ComparisonReport SequenceComparison::report() const {
  return accumulator_->report();
}

double bits_per_coordinate(std::uint64_t bytes, std::uint64_t vertices, std::uint64_t frames) {
  return bits_per_vertex_and_frame(bytes, vertices, frames) / 3;
}

double bits_per_vertex_and_frame(std::uint64_t bytes, std::uint64_t vertices, std::uint64_t frames) {
  const double points = static_cast<double>(vertices) * static_cast<double>(frames);
  return points > 0 ? 8.0 * static_cast<double>(bytes) / points : 0;
}

}  // namespace tvg
