#include "simplify/face_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <tvg/geometry.hpp>

namespace tvg {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;
/// Cells of level l are 2^(l - kLevels) times as large as the extent of 2 that positions of scale 1 stay in.
constexpr int kLevels = 20;

int level_of(const FloatBox& box) {
  const float extent =
      std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
  int exponent = -kLevels;
  if (extent > 0) std::frexp(extent, &exponent);
  return std::clamp(exponent + kLevels, 0, kLevels);
}

}  // namespace

/// The cells of one level that a box touches.
struct FaceGrid::Cells {
  std::array<std::int32_t, 3> low{}, high{};

  Cells(const FloatBox& box, int level) {
    const float scale = std::ldexp(1.0f, kLevels - level);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = static_cast<std::int32_t>(std::floor(box.low[axis] * scale));
      high[axis] = static_cast<std::int32_t>(std::floor(box.high[axis] * scale));
    }
  }

  double count() const {
    return (high[0] - low[0] + 1.0) * (high[1] - low[1] + 1.0) * (high[2] - low[2] + 1.0);
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (std::int32_t x = low[0]; x <= high[0]; ++x) {
      for (std::int32_t y = low[1]; y <= high[1]; ++y) {
        for (std::int32_t z = low[2]; z <= high[2]; ++z) visit(std::array<std::int32_t, 3>{x, y, z});
      }
    }
  }
};

void FaceGrid::clear(std::size_t expected) {
  first_.assign(std::bit_ceil(2 * expected + 16), kNone);
  entries_.clear();
  of_level_.assign(kLevels + 1, {});
}

std::uint32_t FaceGrid::slot(int level, const std::array<std::int32_t, 3>& cell) const {
  std::uint64_t hash = static_cast<std::uint64_t>(level);
  for (const std::int32_t coordinate : cell) hash = mix_hash(hash, static_cast<std::uint32_t>(coordinate));
  return static_cast<std::uint32_t>(hash & (first_.size() - 1));
}

void FaceGrid::insert(std::uint32_t face, const FloatBox& box) {
  const int level = level_of(box);
  of_level_[static_cast<std::size_t>(level)].push_back(face);
  Cells(box, level).for_each([&](const std::array<std::int32_t, 3>& cell) {
    std::uint32_t& first = first_[slot(level, cell)];
    entries_.push_back({face, first});
    first = static_cast<std::uint32_t>(entries_.size() - 1);
  });
}

void FaceGrid::find(const FloatBox& box, std::vector<std::uint32_t>& found) const {
  for (int level = 0; level <= kLevels; ++level) {
    const std::vector<std::uint32_t>& faces = of_level_[static_cast<std::size_t>(level)];
    if (faces.empty()) continue;
    const Cells cells(box, level);
    if (cells.count() >= static_cast<double>(faces.size())) {
      found.insert(found.end(), faces.begin(), faces.end());
      continue;
    }
    cells.for_each([&](const std::array<std::int32_t, 3>& cell) {
      for (std::uint32_t i = first_[slot(level, cell)]; i != kNone; i = entries_[i].next) {
        found.push_back(entries_[i].face);
      }
    });
  }
}

}  // namespace tvg
