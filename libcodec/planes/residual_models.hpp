#pragma once
#include "entropy/adaptive_models.hpp"
#include "entropy/kept_coder.hpp"
#include "planes/lanes.hpp"
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

/// Where the models of a vertex's residuals stand, one lane for each plane of the group: the contexts of the
/// planes that are coded choose it.
struct GroupChoice {
  std::size_t set;      ///< below the number of sets
  Lanes activity;       ///< weighted sums of the sizes of residuals already coded around, not negative
  Lanes first, second;  ///< 0 to 14
};

class ResidualModels {
 public:
  /// `set_count` independent sets of models, all in their initial state.
  explicit ResidualModels(std::size_t set_count)
      : models_(set_count * kLevels * kPerLevel), escape_lengths_(set_count * kLevels) {}

  /// What so many sets take of memory.
  static constexpr std::size_t bytes(std::size_t set_count) {
    return set_count * kLevels *
           (kPerLevel * sizeof(AdaptiveSymbol) + sizeof(residual_alphabet::EscapeLength));
  }

  /// Codes the residuals of a vertex in `kPlanes` planes, each in its lane of the coder, and returns them; a
  /// decoder ignores those given. First come the symbols of all, then what these do not say.
  template <std::size_t kPlanes, class Coder>
  [[gnu::always_inline]] Lanes code(Coder& coder, GroupChoice choice, Lanes residuals) {
    if (any(choice.activity > kMostActivity)) [[unlikely]]
      choice.activity = clamp<kMostActivity>(choice.activity);
    Quad high{};
#pragma GCC unroll 4
    for (std::size_t plane = 0; plane < kPlanes; ++plane) {
      const std::size_t level = level_of(choice, plane);
      AdaptiveSymbol* const models = models_.data() + kPerLevel * (kLevels * choice.set + level);
      const std::uint32_t wanted =
          Coder::kDecoding ? 0 : residual_alphabet::symbol_of(residuals[plane] >> kRawBits[level]);
      const std::uint32_t symbol =
          coder.lane(plane).code(models[static_cast<std::uint32_t>(choice.first[plane])],
                                 models[kSecond + static_cast<std::uint32_t>(choice.second[plane])], wanted);
      high[plane] = static_cast<std::int32_t>(symbol) - residual_alphabet::kLargest;
    }
    const Lanes coded(high[0], high[1], high[2], high[3]);
    if (!any((choice.activity > kFirstRaw - 1) | (coded > residual_alphabet::kLargest))) [[likely]]
      return coded;
    return Lanes(code_rest<kPlanes>(coder, choice, coded, residuals));
  }

 private:
  std::size_t level_of(const GroupChoice& choice, std::size_t plane) const {
    return kLevelOf[static_cast<std::uint32_t>(choice.activity[plane])];
  }

  template <std::size_t kPlanes, class Coder>
  [[gnu::always_inline]] Quad code_rest(Coder& coder, const GroupChoice& choice, Lanes high,
                                        Lanes residuals) {
    Quad coded{};
#pragma GCC unroll 4
    for (std::size_t plane = 0; plane < kPlanes; ++plane) {
      const std::size_t level = level_of(choice, plane);
      coded[plane] = residual_alphabet::code_rest(coder.lane(plane), high[plane],
                                                  escape_lengths_[kLevels * choice.set + level],
                                                  kRawBits[level], residuals[plane]);
    }
    return coded;
  }

  static constexpr std::size_t kPerLevel = 32;
  static constexpr std::size_t kSecond = 16;
  static constexpr std::size_t kLevels = 16;
  static constexpr std::int32_t kFirstRaw = 45;  ///< the activity from which on there are raw bits
  static constexpr std::int32_t kMostActivity = 255;
  static constexpr std::array<std::uint8_t, kLevels> kRawBits = {0, 0, 0, 0, 0, 0, 0, 0,
                                                                 0, 1, 1, 1, 2, 2, 3, 3};
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

  std::vector<AdaptiveSymbol> models_;  ///< [set][level][first 0 to 14, second 16 to 30]
  std::vector<residual_alphabet::EscapeLength> escape_lengths_;  ///< [set][level]
};

}  // namespace tvg
