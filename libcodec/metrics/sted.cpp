#include "metrics/sted.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

double first_frame_diagonal(const Points& points) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Vector3d high = -low;
  for (const Vector3d& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return points.empty() ? 0 : (high - low).norm();
}

std::array<std::uint32_t, 2> edge_of(const Face& face, std::size_t k) {
  const std::uint32_t a = face[k], b = face[(k + 1) % 3];
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

EdgeDifference::EdgeDifference(const Mesh& mesh) : begin_(mesh.vertex_count + std::size_t{1}, 0) {
  for (const Face& face : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto edge = edge_of(face, k);
      if (edge[0] != edge[1]) edges_.push_back(edge);
    }
  }
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());

  std::vector<std::array<std::uint32_t, 2>> uses;  // vertex, edge
  for (const Face& face : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto edge = edge_of(face, k);
      if (edge[0] == edge[1]) continue;
      const auto place = std::lower_bound(edges_.begin(), edges_.end(), edge);
      for (const std::uint32_t v : face)
        uses.push_back({v, static_cast<std::uint32_t>(place - edges_.begin())});
    }
  }
  std::sort(uses.begin(), uses.end());
  uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
  for (const auto& [vertex, edge] : uses) {
    ++begin_[vertex + std::size_t{1}];
    vertex_edges_.push_back(edge);
  }
  for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
  length_.resize(edges_.size());
  error_.resize(edges_.size());
}

void EdgeDifference::add_frame(const Points& original, const Points& decoded) {
  if (frames_ == 0) {
    const double diagonal = first_frame_diagonal(original);
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
