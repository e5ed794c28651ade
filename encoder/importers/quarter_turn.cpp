#include "encoder/importers/quarter_turn.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include <tvg/geometry.hpp>

namespace tvg::cli {

namespace {

std::array<float, 3> turned(Turn turn, float x, float y, float z) {
  return turn == Turn::kZUpToYUp ? std::array{x, z, -y} : std::array{x, -z, y};
}

/// The root mean square distance of two frames, one of them turned where `turn` says so.
double distance(std::span<const float> mesh, std::span<const float> cache, std::optional<Turn> turn) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < mesh.size(); i += 3) {
    const std::array<float, 3> there = turn ? turned(*turn, cache[i], cache[i + 1], cache[i + 2])
                                            : std::array{cache[i], cache[i + 1], cache[i + 2]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = double{mesh[i + axis]} - double{there[axis]};
      sum += d * d;
    }
  }
  return std::sqrt(3 * sum / static_cast<double>(mesh.size()));
}

}  // namespace

std::optional<Turn> find_quarter_turn(std::span<const float> mesh, std::span<const float> cache) {
  constexpr double kNear = 0.1;  // of the diagonal: the first frame need not be the mesh itself
  constexpr double kTimesNearer = 4;
  if (mesh.empty() || mesh.size() != cache.size()) return std::nullopt;
  BoundingBox box;
  box.extend(mesh);
  const double as_it_is = distance(mesh, cache, std::nullopt);
  for (const Turn turn : {Turn::kZUpToYUp, Turn::kYUpToZUp}) {
    const double there = distance(mesh, cache, turn);
    if (there < kNear * box.diagonal() && kTimesNearer * there < as_it_is) return turn;
  }
  return std::nullopt;
}

Result<bool> TurnedSource::read_frame(std::span<float> positions) {
  Result<bool> read = SourceDecorator::read_frame(positions);
  if (!read || !*read) return read;
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
    const std::array<float, 3> there = turned(turn_, positions[i], positions[i + 1], positions[i + 2]);
    for (std::size_t axis = 0; axis < 3; ++axis) positions[i + axis] = there[axis];
  }
  return read;
}

}  // namespace tvg::cli
