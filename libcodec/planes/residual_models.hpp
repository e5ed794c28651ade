#pragma once
#include "entropy/adaptive_models.hpp"
#include "planes/residual_alphabet.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

// How a residual is coded (format-spec §7.3): the models of its symbol. Both are chosen by the size residuals
// have had around here; one also by where the gate's residuals lean, the other by what the vertex did in the
// frame before.
namespace tvg {

/// Where a residual's models stand: the contexts of the planes that are coded choose it.
struct ModelChoice {
  std::size_t set;         ///< below the number of sets
  std::uint32_t activity;  ///< weighted sum of the sizes of residuals already coded around
  std::uint32_t first;     ///< 0 to 14
  std::uint32_t second;    ///< 0 to 14
};

class ResidualModels {
 public:
  /// `set_count` independent sets of models, all in their initial state.
  explicit ResidualModels(std::size_t set_count) : cells_(set_count * kLevels) {}

  /// What so many sets take of memory.
  static constexpr std::size_t bytes(std::size_t set_count) { return set_count * kLevels * sizeof(Cell); }

  /// Codes one residual and returns it; a decoder ignores the argument.
  template <class Coder>
  [[gnu::always_inline]] std::int32_t code(Coder& coder, const ModelChoice& choice, std::int32_t residual) {
    const std::size_t level = kLevelOf[std::min<std::uint32_t>(choice.activity, kLevelOf.size() - 1)];
    Cell& cell = cells_[kLevels * choice.set + level];
    return residual_alphabet::code(coder, cell.first[choice.first], cell.second[choice.second],
                                   cell.escape_length, kRawBits[level], residual);
  }

 private:
  static constexpr std::size_t kLevels = 16;
  static constexpr std::array<std::uint8_t, kLevels> kRawBits = {0, 0, 0, 0, 0, 0, 0, 0,
                                                                 0, 0, 0, 1, 1, 2, 2, 3};
  /// Level l begins where the activity reaches kThresholds[l - 1] (about 4 (2^(l / 2.5) - 1)).
  static constexpr std::array<std::uint16_t, kLevels - 1> kThresholds = {2,  3,  6,  9,   12,  18,  24, 33,
                                                                         45, 60, 81, 108, 144, 190, 252};
  static constexpr std::array<std::uint8_t, 256> kLevelOf = [] {
    std::array<std::uint8_t, 256> levels{};
    for (std::size_t activity = 0; activity < levels.size(); ++activity) {
      while (levels[activity] < kThresholds.size() && activity >= kThresholds[levels[activity]])
        ++levels[activity];
    }
    return levels;
  }();

  struct Cell {
    std::array<AdaptiveSymbol, 15> first;
    std::array<AdaptiveSymbol, 15> second;
    residual_alphabet::EscapeLength escape_length;
  };

  std::vector<Cell> cells_;  ///< [set][level]
};

}  // namespace tvg
