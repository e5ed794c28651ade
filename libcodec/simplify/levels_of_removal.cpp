#include "simplify/levels_of_removal.hpp"

#include "simplify/isolated_vertices.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tvg {
namespace {

/// Vertices of a higher degree are left alone, as the paper has it; where all else is refused, of this one.
constexpr std::uint32_t kLargestDegree = 12, kLargestRelaxedDegree = 64;
/// A level that removes less than this share of the vertices has stalled. What follows takes vertices of a
/// higher degree and those that were refused before, then in the opposite order as well, and then lets
/// creases be made.
constexpr std::uint32_t kStalledShare = 200;
constexpr std::uint32_t kAttempts = 4, kReversed = 2, kCreased = 3;
constexpr std::uint32_t kProgressStep = 256;

}  // namespace

LevelsOfRemoval::LevelsOfRemoval(const Mesh& mesh, std::span<const FramePositions> frames,
                                 VertexRemover& remover, const Priorities& priorities,
                                 const SimplifyProgress& progress)
    : mesh_(mesh),
      frames_(frames),
      remover_(remover),
      priorities_(priorities),
      progress_(progress),
      left_(mesh.vertex_count),
      gone_(mesh.vertex_count, 0),
      refused_(remover.mesh().vertex_count(), 0),
      blocked_(refused_.size(), 0) {}

Status LevelsOfRemoval::run(std::span<const std::uint32_t> vertex_counts) {
  last_target_ = vertex_counts.back();
  remove_isolated(frames_[0]);
  std::size_t next = 0;
  std::uint32_t stalled = 0;
  while (next < vertex_counts.size() && stalled < kAttempts) {
    const std::uint32_t before = left_, target = vertex_counts[next];
    if (left_ > target) {
      if (Status status = run_level(target, stalled); !status.ok()) return status;
    }
    const bool reached = left_ <= target;
    if (reached) {
      keep();
      ++next;
    }
    stalled = reached || (before - left_) >= std::max(1u, before / kStalledShare) ? 0 : stalled + 1;
  }
  for (; next < vertex_counts.size(); ++next) keep();
  if (progress_)
    progress_(static_cast<std::uint32_t>(removed.size()), static_cast<std::uint32_t>(removed.size()));
  return {};
}

void LevelsOfRemoval::remove_isolated(std::span<const float> positions) {
  stand_in_ = stand_ins(remover_.mesh().cut().used, mesh_.vertex_count, positions);
  for (std::uint32_t v = 0; v < mesh_.vertex_count; ++v) {
    if (stand_in_[v] == v) continue;
    gone_[v] = 1;
    removed.push_back(v);
    ++level_.removed;
    --left_;
  }
  if (level_.removed > 0) end_level();
}

Status LevelsOfRemoval::run_level(std::uint32_t target, std::uint32_t attempt) {
  const Result<std::vector<double>> priorities = priorities_(remover_.mesh().present());
  if (!priorities) return priorities.error();
  std::vector<std::uint32_t> order;
  for (std::uint32_t v = 0; v < mesh_.vertex_count; ++v) {
    if (remover_.mesh().removable(v)) order.push_back(v);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return (*priorities)[a] < (*priorities)[b]; });
  if (attempt == kCreased) remover_.allow_creases();
  if (attempt == kReversed) std::reverse(order.begin(), order.end());
  if (attempt > 0) std::fill(refused_.begin(), refused_.end(), std::uint8_t{0});
  std::fill(blocked_.begin(), blocked_.end(), std::uint8_t{0});
  remover_.begin_level();
  remove_in_order(order, target, attempt);
  if (level_.removed > 0) end_level();
  return {};
}

void LevelsOfRemoval::remove_in_order(std::span<const std::uint32_t> order, std::uint32_t target,
                                      std::uint32_t attempt) {
  const std::uint32_t largest_degree = attempt > 0 ? kLargestRelaxedDegree : kLargestDegree;
  for (const std::uint32_t v : order) {
    if (left_ == target) return;
    if (blocked_[v] != 0 || refused_[v] != 0 || remover_.mesh().degree(v) > largest_degree) continue;
    if (!remover_.remove(v)) {
      refused_[v] = 1;
      ++level_.refused;
      continue;
    }
    for (const std::uint32_t neighbour : remover_.last_ring()) {
      blocked_[neighbour] = 1;
      refused_[neighbour] = 0;
    }
    gone_[v] = 1;
    removed.push_back(v);
    ++level_.removed;
    --left_;
    if (progress_ && removed.size() % kProgressStep == 0) {
      const auto done = static_cast<std::uint32_t>(removed.size());
      progress_(done, done + left_ - std::min(left_, last_target_));
    }
  }
}

void LevelsOfRemoval::end_level() {
  const HalfEdgeMesh& mesh = remover_.mesh();
  level_.vertices = left_;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) level_.faces += mesh.has_face(f) ? 1 : 0;
  levels.push_back(std::exchange(level_, {}));
  std::vector<PlacedVertex>& now = placed.emplace_back();
  for (const std::uint32_t v : removed) {
    if (stand_in_[v] != v) continue;
    const FacePoint& point = remover_.parameterization().place(v);
    now.push_back(
        {v,
         {mesh.origin(point.corners[0]), mesh.origin(point.corners[1]), mesh.origin(point.corners[2])},
         point.weights});
  }
}

SurfacePlace LevelsOfRemoval::place_of(std::uint32_t vertex, std::span<const std::uint32_t> face_numbers,
                                       std::span<const SurfacePlace> of_corners) const {
  if (gone_[vertex] == 0) return of_corners[vertex];
  const FacePoint& point = remover_.parameterization().place(vertex);
  return {face_numbers[point.face], point.weights};
}

void LevelsOfRemoval::keep() {
  const HalfEdgeMesh& mesh = remover_.mesh();
  Kept& result = kept.emplace_back();
  result.levels = levels.size();
  SimplifiedMesh& simple = result.mesh;
  std::vector<std::uint32_t> number(mesh_.vertex_count, 0), face_numbers(mesh.face_count(), 0);
  for (std::uint32_t v = 0; v < mesh_.vertex_count; ++v) {
    if (gone_[v] != 0) continue;
    number[v] = static_cast<std::uint32_t>(simple.vertices.size());
    simple.vertices.push_back(v);
  }
  simple.mesh.vertex_count = static_cast<std::uint32_t>(simple.vertices.size());
  std::vector<SurfacePlace> of_corners(mesh_.vertex_count);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (!mesh.has_face(f)) continue;
    face_numbers[f] = static_cast<std::uint32_t>(simple.mesh.faces.size());
    const Face face = mesh.original_face(f);
    simple.mesh.faces.push_back({number[face[0]], number[face[1]], number[face[2]]});
    for (std::size_t c = 0; c < 3; ++c) {
      of_corners[face[c]] = {face_numbers[f], {c == 0 ? 1.0 : 0.0, c == 1 ? 1.0 : 0.0, c == 2 ? 1.0 : 0.0}};
    }
  }
  for (std::uint32_t v = 0; v < mesh_.vertex_count; ++v) {
    simple.places.push_back(place_of(stand_in_[v], face_numbers, of_corners));
  }
}

}  // namespace tvg
