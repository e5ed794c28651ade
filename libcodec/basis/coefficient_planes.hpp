#pragma once
#include "planes/lanes.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// The coefficients of a basis as sums over them read them: planes of 16 bits in pairs, eight vertices at a
/// time; planes with larger coefficients by themselves.
class CoefficientPlanes {
 public:
  static constexpr std::size_t kAtOnce = 8;  ///< vertices of a block
  /// Two neighbouring planes of one vertex.
  using Pair = std::array<std::int16_t, 2>;
  using PairBlock = std::array<Pair, kAtOnce>;

  /// What is allocated for so many vertices and components, at most.
  static constexpr std::uint64_t most_bytes(std::uint64_t vertices, std::uint64_t components) {
    return (components + 4) * (4 * (vertices + kAtOnce) + 64);
  }

  /// Makes room; false where there is none. All coefficients are zero.
  bool reserve(std::size_t vertices, std::size_t components);
  /// Takes a group of planes, `values` [vertex], of which the first is component 4 * group. False where there
  /// is no memory.
  bool put(std::size_t group, std::span<const Quad> values);

  std::size_t vertex_count() const { return vertices_; }
  std::size_t block_count() const { return (vertices_ + kAtOnce - 1) / kAtOnce; }
  std::size_t component_count() const { return most_.size(); }
  std::size_t pair_count() const { return (most_.size() + 1) / 2; }
  /// The size of a component's largest coefficient.
  std::int32_t most(std::size_t component) const { return most_[component]; }

  /// Eight vertices of pair 0, then of pair 1 and so on; those of a large plane are zero.
  const PairBlock* pairs(std::size_t block) const { return pairs_.data() + block * pair_count(); }

  /// A plane whose coefficients do not fit 16 bits.
  struct Large {
    std::size_t component;
    std::vector<std::int32_t> values;  ///< [vertex], padded to whole blocks
  };
  std::span<const Large> large() const { return large_; }

 private:
  std::size_t vertices_ = 0;
  std::vector<std::int32_t> most_;  ///< [component]
  std::vector<PairBlock> pairs_;    ///< [block][pair]
  std::vector<Large> large_;        ///< by component
};

}  // namespace tvg
