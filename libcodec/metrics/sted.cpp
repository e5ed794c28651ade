#include "metrics/sted.hpp"

#include "geometry/half_edges_encode.hpp"

#include <algorithm>
#include <cmath>

#include <tvg/geometry.hpp>

namespace tvg {

namespace {

using Eigen::Vector3d;

/// The weighted deviation of relative errors, in one pass.
class Deviation {
 public:
  void add(double length, double error) {
    weight_ += length;
    first_ += length * error;
    second_ += length * error * error;
  }
  bool empty() const { return !(weight_ > 0); }
  double value() const {
    const double mean = first_ / weight_;
    return std::sqrt(std::max(0.0, second_ / weight_ - mean * mean));
  }

 private:
  double weight_ = 0, first_ = 0, second_ = 0;
};

double relative_error(double original, double decoded) {
  return original > 0 ? std::abs(original - decoded) / original : 0;
}

double diagonal_of(const Points& points) {
  BoundingBox box;
  for (const Vector3d& point : points) box.extend(point[0], point[1], point[2]);
  return box.diagonal();
}

}  // namespace

EdgeDifference::EdgeDifference(const Mesh& mesh) {
  std::vector<std::uint32_t> edge_of(3 * mesh.faces.size(), kNoHalfEdge);  // [half-edge]
  for (const HalfEdge& half_edge : half_edges_by_edge(mesh)) {
    const std::array<std::uint32_t, 2> ends = {half_edge.low, half_edge.high};
    if (edges_.empty() || edges_.back() != ends) edges_.push_back(ends);
    edge_of[half_edge.id] = static_cast<std::uint32_t>(edges_.size() - 1);
  }
  length_.resize(edges_.size());
  error_.resize(edges_.size());

  const OneRings rings(mesh);
  std::vector<std::uint32_t> around;
  begin_.push_back(0);
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
    around.clear();
    for (const std::uint32_t f : rings.faces_at(v)) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t edge = edge_of[3 * std::size_t{f} + c];
        if (edge != kNoHalfEdge) around.push_back(edge);
      }
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    vertex_edges_.insert(vertex_edges_.end(), around.begin(), around.end());
    begin_.push_back(vertex_edges_.size());
  }
}

void EdgeDifference::add_frame(const Points& original, const Points& decoded) {
  if (frames_ == 0) {
    const double diagonal = diagonal_of(original);
    frame_length_ = kStedFrameLength * (diagonal > 0 ? diagonal : 1);
  } else {
    add_temporal(original, decoded);
  }
  add_spatial(original, decoded);
  last_original_ = original;
  last_decoded_ = decoded;
  ++frames_;
}

void EdgeDifference::add_spatial(const Points& original, const Points& decoded) {
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto& [a, b] = edges_[e];
    length_[e] = (original[a] - original[b]).norm();
    error_[e] = relative_error(length_[e], (decoded[a] - decoded[b]).norm());
  }
  for (std::size_t v = 0; v + 1 < begin_.size(); ++v) {
    Deviation deviation;
    for (std::size_t k = begin_[v]; k < begin_[v + 1]; ++k) {
      deviation.add(length_[vertex_edges_[k]], error_[vertex_edges_[k]]);
    }
    if (deviation.empty()) continue;
    spatial_sum_ += deviation.value();
    ++spatial_count_;
  }
}

void EdgeDifference::add_temporal(const Points& original, const Points& decoded) {
  std::vector<double>& lengths = step_length_[frames_ % kStedWindow];
  std::vector<double>& errors = step_error_[frames_ % kStedWindow];
  lengths.resize(original.size());
  errors.resize(original.size());
  for (std::size_t v = 0; v < original.size(); ++v) {
    lengths[v] = std::hypot((original[v] - last_original_[v]).norm(), frame_length_);
    errors[v] = relative_error(lengths[v], std::hypot((decoded[v] - last_decoded_[v]).norm(), frame_length_));
  }
  const std::size_t steps = std::min(frames_, kStedWindow);
  for (std::size_t v = 0; v < original.size(); ++v) {
    Deviation deviation;
    for (std::size_t s = 0; s < steps; ++s) {
      const std::size_t slot = (frames_ - s) % kStedWindow;
      deviation.add(step_length_[slot][v], step_error_[slot][v]);
    }
    temporal_sum_ += deviation.value();
    ++temporal_count_;
  }
}

double EdgeDifference::spatial() const {
  return spatial_count_ > 0 ? spatial_sum_ / spatial_count_ : 0;
}

double EdgeDifference::temporal() const {
  return temporal_count_ > 0 ? temporal_sum_ / temporal_count_ : 0;
}

double EdgeDifference::combined() const {
  return std::hypot(spatial(), kStedTemporalWeight * temporal());
}

}  // namespace tvg
