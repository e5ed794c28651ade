#include "base/errors.hpp"
#include "simplify/levels_of_removal.hpp"
#include "simplify/priority.hpp"
#include "simplify/removal_history.hpp"
#include "simplify/vertex_levels.hpp"
#include "simplify/vertex_remover.hpp"
#include "source/source_checks.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include <tvg/simplify.hpp>

namespace tvg {
namespace {

Status check_options(const SimplifyOptions& options) {
  const std::vector<std::uint32_t>& counts = options.vertex_counts;
  if (counts.empty()) return invalid_argument("simplification needs a number of vertices to end at");
  if (counts.size() >= kMaxVertexLevels) {
    return invalid_argument("a mesh can be kept at " + std::to_string(kMaxVertexLevels - 1) +
                            " numbers of vertices at most");
  }
  if (std::adjacent_find(counts.begin(), counts.end(), std::less_equal<>()) != counts.end()) {
    return invalid_argument("the numbers of vertices must fall from one to the next");
  }
  if (counts.back() < 3) return invalid_argument("a mesh has at least 3 vertices");
  if (!(options.lambda >= 0 && options.lambda <= 1)) {
    return invalid_argument("lambda must lie between 0 and 1");
  }
  if (!(options.largest_turn >= 0 && options.largest_turn <= 180)) {
    return invalid_argument("the largest turn of a face must lie between 0 and 180 degrees");
  }
  return {};
}

bool has_area(const Mesh& mesh, std::span<const float> positions) {
  const auto position = [&positions](std::uint32_t v) {
    return Eigen::Map<const Eigen::Vector3f>(positions.data() + 3 * std::size_t{v}).cast<double>();
  };
  return std::any_of(mesh.faces.begin(), mesh.faces.end(), [&](const Face& face) {
    const Eigen::Vector3d a = position(face[0]);
    return (position(face[1]) - a).cross(position(face[2]) - a).squaredNorm() > 0;
  });
}

Status check_input(const Mesh& mesh, std::span<const FramePositions> frames) {
  if (Status status = check_mesh(mesh); !status.ok()) return status;
  if (frames.empty()) return invalid_argument("there is no frame of the mesh to simplify");
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (frames[f].size() != 3 * std::size_t{mesh.vertex_count}) {
      return at_frame(f, invalid_input("the frame has not the mesh's vertices"));
    }
    if (Status status = check_frame(frames[f], f); !status.ok()) return status;
  }
  const auto of_mesh = [&mesh](const FramePositions& frame) { return has_area(mesh, frame); };
  if (std::none_of(frames.begin(), frames.end(), of_mesh)) {
    return invalid_input("the mesh has no face with an area");
  }
  return {};
}

}  // namespace

Result<Simplification> simplify(const Mesh& mesh, std::span<const FramePositions> frames,
                                const Skeleton& skeleton, std::span<const std::vector<float>> joints,
                                const SimplifyOptions& options, const SimplifyProgress& progress) {
  if (Status status = check_options(options); !status.ok()) return status.error();
  if (Status status = check_input(mesh, frames); !status.ok()) return status.error();
  const bool measured = options.priority == SimplifyPriority::kMeasure;
  if (measured) {
    if (Status status = check_importance(options.importance, mesh, skeleton); !status.ok())
      return status.error();
  }
  const Priorities priorities = [&](const Mesh& present) -> Result<std::vector<double>> {
    if (!measured) return maps_priorities(present, frames, options.lambda);
    Result<Measure> result = measure(present, frames, skeleton, joints, options.importance);
    if (!result) return result.error();
    return std::move(result->cost);
  };
  VertexRemover remover(mesh, frames, options);
  LevelsOfRemoval run(mesh, frames, remover, priorities, progress);
  if (Status status = run.run(options.vertex_counts); !status.ok()) return status.error();

  Simplification result;
  result.mesh_levels = vertex_levels(mesh.vertex_count, run);
  std::vector<std::vector<double>> errors = quadric_errors(mesh, frames, run.placed);
  for (std::size_t i = 0; i < errors.size(); ++i) run.levels[i].quadric_error = std::move(errors[i]);
  result.levels = std::move(run.levels);
  for (LevelsOfRemoval::Kept& kept : run.kept) result.meshes.push_back(std::move(kept.mesh));
  result.removed = std::move(run.removed);
  result.history = std::make_shared<const RemovalHistory>(remover.mesh(), remover.take_removals());
  return result;
}

void positions_of(const Mesh& mesh, std::span<const SurfacePlace> places, std::span<const float> positions,
                  std::span<float> result) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Face& face = mesh.faces[places[i].face];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        sum += places[i].weights[c] * positions[3 * std::size_t{face[c]} + axis];
      }
      result[3 * i + axis] = static_cast<float>(sum);
    }
  }
}

}  // namespace tvg
