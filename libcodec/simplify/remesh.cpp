#include "base/errors.hpp"
#include "simplify/removal_history.hpp"
#include "simplify/subdivision.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <tvg/simplify.hpp>

namespace tvg {
namespace {

Status check(const Simplification& simplification, const Mesh& mesh, std::span<const FramePositions> frames,
             const RemeshOptions& options) {
  if (!simplification.history || simplification.meshes.empty() ||
      simplification.history->vertex_count() != mesh.vertex_count) {
    return invalid_argument("the simplification is not one of this mesh");
  }
  if (options.levels > kMaxRemeshLevels) {
    return invalid_argument("faces can be cut in four " + std::to_string(kMaxRemeshLevels) +
                            " times at most");
  }
  const std::size_t faces = simplification.meshes.back().mesh.faces.size();
  if (faces > kMaxFaceCount >> 2 * options.levels) {
    return invalid_argument("there would be more faces than a mesh can have");
  }
  if (!options.largest_distance) return {};
  if (!(*options.largest_distance >= 0)) return invalid_argument("the largest distance must not be below 0");
  if (frames.empty()) return invalid_argument("a largest distance needs frames to hold in");
  for (const FramePositions& frame : frames) {
    if (frame.size() != 3 * std::size_t{mesh.vertex_count}) {
      return invalid_argument("a frame has not the mesh's vertices");
    }
  }
  return {};
}

std::array<double, 3> position_of(const Mesh& mesh, const SurfacePlace& place, const FramePositions& frame) {
  std::array<double, 3> result{};
  const Face& face = mesh.faces[place.face];
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result[axis] += place.weights[c] * frame[3 * std::size_t{face[c]} + axis];
    }
  }
  return result;
}

/// Whether in any frame a place lies further than `largest` from the mean of the others.
bool is_far(const Mesh& mesh, std::span<const FramePositions> frames, const SurfacePlace& place,
            std::span<const SurfacePlace> others, double largest) {
  return std::any_of(frames.begin(), frames.end(), [&](const FramePositions& frame) {
    std::array<double, 3> apart = position_of(mesh, place, frame);
    for (const SurfacePlace& other : others) {
      const std::array<double, 3> at = position_of(mesh, other, frame);
      for (std::size_t axis = 0; axis < 3; ++axis)
        apart[axis] -= at[axis] / static_cast<double>(others.size());
    }
    return std::hypot(apart[0], apart[1], apart[2]) > largest;
  });
}

/// The base domain as it is cut up, and where the vertices lie on the original.
class Remesher {
 public:
  Remesher(const Simplification& simplification, const Mesh& mesh, std::span<const FramePositions> frames)
      : history_(*simplification.history),
        mesh_(mesh),
        frames_(frames),
        domain_(simplification.meshes.back().mesh) {
    for (const std::uint32_t v : simplification.meshes.back().vertices) {
      places_.push_back(history_.at_vertices()[v]);
    }
  }

  /// Cuts every edge, or those from which the original is too far. False where there is none.
  bool cut(const std::optional<double>& largest) {
    std::vector<std::uint8_t> marks(domain_.edges().size(), 1);
    const std::vector<SurfacePlace> middles = on_original(domain_.middles_of_edges());
    if (largest) mark(middles, *largest, marks);
    for (std::size_t e = 0; e < marks.size(); ++e) {
      if (marks[e] != 0) places_.push_back(middles[e]);
    }
    domain_.cut(marks);
    return std::find(marks.begin(), marks.end(), std::uint8_t{1}) != marks.end();
  }

  Remesh take() { return {domain_.mesh(), std::move(places_)}; }

 private:
  std::vector<SurfacePlace> on_original(const std::vector<SurfacePlace>& in_domain) const {
    std::vector<FacePoint> points;
    points.reserve(in_domain.size());
    for (const SurfacePlace& place : in_domain) {
      points.push_back(history_.base()[place.face]);
      points.back().weights = place.weights;
    }
    return history_.on_original(std::move(points));
  }

  void mark(std::span<const SurfacePlace> middles, double largest, std::span<std::uint8_t> marks) const {
    for (std::size_t e = 0; e < marks.size(); ++e) {
      const auto [a, b] = domain_.edges()[e];
      const std::array<SurfacePlace, 2> ends = {places_[a], places_[b]};
      marks[e] = is_far(mesh_, frames_, middles[e], ends, largest) ? 1 : 0;
    }
    const std::vector<SurfacePlace> centers = on_original(domain_.middles_of_faces());
    for (std::size_t f = 0; f < centers.size(); ++f) {
      const Face corners = domain_.face(f);
      const std::array<SurfacePlace, 3> ends = {places_[corners[0]], places_[corners[1]],
                                                places_[corners[2]]};
      if (!is_far(mesh_, frames_, centers[f], ends, largest)) continue;
      for (const std::uint32_t edge : domain_.edges_of(f)) marks[edge] = 1;
    }
  }

  const RemovalHistory& history_;
  const Mesh& mesh_;
  std::span<const FramePositions> frames_;
  Subdivision domain_;
  std::vector<SurfacePlace> places_;  ///< [vertex] in a face of the original
};

}  // namespace

Result<Remesh> remesh(const Simplification& simplification, const Mesh& mesh,
                      std::span<const FramePositions> frames, const RemeshOptions& options) {
  if (Status status = check(simplification, mesh, frames, options); !status.ok()) return status.error();
  Remesher remesher(simplification, mesh, frames);
  for (std::uint32_t level = 0; level < options.levels; ++level) {
    if (!remesher.cut(options.largest_distance)) break;
  }
  return remesher.take();
}

}  // namespace tvg
