#pragma once
#include "planes/lanes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// What a vertex missed the mean of its neighbours by, remembered over the frames at four rates, and which of
// the four to believe (format-spec §7.7.3). Values are in 1/64 of a cell.
namespace tvg {

inline constexpr int kDetailBits = 6;

/// The details of all vertices of three planes, and the errors that predictions by each of them made.
class DetailBlend {
 public:
  static constexpr std::size_t kRates = 4;
  static constexpr std::size_t kBytesPerVertex = 2 * kRates * sizeof(Quad);
  /// Neighbours whose errors count, too.
  static constexpr std::size_t kNearest = 6;

  explicit DetailBlend(std::size_t vertex_count) : states_(vertex_count) {
    for (State& state : states_) {
      for (Quad& error : state.error) error.fill(kFirstError);
    }
  }

  /// The detail to be expected of a vertex: the four, each weighted by the inverse square of its mean squared
  /// error here and at the nearest neighbours.
  Quad expected(std::uint32_t v, std::span<const std::uint32_t> neighbours) const {
    const std::size_t count = std::min(neighbours.size(), kNearest);
    const State& own = states_[v];
    std::array<Lanes, kRates> sums;
    for (std::size_t rate = 0; rate < kRates; ++rate) {
      Lanes around;
      for (std::size_t j = 0; j < count; ++j) around = around + Lanes(states_[neighbours[j]].error[rate]);
      const Lanes error(own.error[rate]);
      sums[rate] = (error << 2) + error + (around << 2);
    }
    Quad expected{};
    for (std::size_t plane = 0; plane < 3; ++plane) expected[plane] = blend(own, sums, plane, count);
    return expected;
  }

  /// Takes the details of a frame of which so many came before it in the GOP.
  void take(std::uint32_t v, const Quad& details, std::uint32_t frames_before) {
    State& state = states_[v];
    const std::int32_t slow = kSlowRates[std::min<std::size_t>(frames_before, kSlowRates.size() - 1)];
    for (std::size_t plane = 0; plane < 3; ++plane) {
      const std::int32_t detail = details[plane];
      if (frames_before == 0) {
        for (Quad& kept : state.detail) kept[plane] = detail;
        continue;
      }
      for (std::size_t rate = 0; rate < kRates; ++rate) {
        const std::int32_t missed = std::clamp(detail - state.detail[rate][plane], -kMostMissed, kMostMissed);
        std::int32_t& error = state.error[rate][plane];
        error += (((missed * missed) >> 4) - error) * 5 >> 4;
      }
      state.detail[0][plane] = detail;
      state.detail[1][plane] += (detail - state.detail[1][plane]) >> 1;
      state.detail[2][plane] += (detail - state.detail[2][plane]) >> 2;
      state.detail[3][plane] +=
          static_cast<std::int32_t>((std::int64_t{detail} - state.detail[3][plane]) * slow >> 16);
    }
  }

 private:
  static constexpr std::int32_t kFirstError = 256;            ///< a cell squared, in 1/256
  static constexpr std::int32_t kMostMissed = (1 << 14) - 1;  ///< 256 cells

  struct State {
    std::array<Quad, kRates> detail{};
    std::array<Quad, kRates> error{};  ///< mean squared, in 1/256 of a cell squared
  };

  /// 2^16 over the number of frames there are with this one, at most ten.
  static constexpr std::array<std::int32_t, 10> kSlowRates = {65536, 32768, 21845, 16384, 13107,
                                                              10922, 9362,  8192,  7281,  6553};
  /// [number of neighbours]: 2^16 over five times the own error and four times each neighbour's.
  static constexpr std::array<std::uint32_t, kNearest + 1> kShares = {13107, 7281, 5041, 3855,
                                                                      3120,  2621, 2259};
  /// 2^(16 - i / 8): how much less a rate counts whose mean squared error is i sixteenths of an octave above
  /// the least.
  static constexpr std::array<std::int32_t, 129> kCredit = [] {
    std::array<std::int32_t, 129> credit{};
    constexpr std::array<std::int32_t, 8> kEighths = {65536, 60097, 55109, 50535, 46341, 42495, 38968, 35734};
    for (std::size_t i = 0; i < credit.size(); ++i) credit[i] = kEighths[i % 8] >> (i / 8);
    return credit;
  }();

  /// 16 log2(x), nearly: sixteen steps to an octave.
  static std::int32_t sixteenths(std::uint32_t x) {
    const int whole = std::bit_width(x) - 1;
    return 16 * whole + static_cast<std::int32_t>((std::uint64_t{x} << 4 >> whole) & 15);
  }

  static std::int32_t blend(const State& own, const std::array<Lanes, kRates>& sums, std::size_t plane,
                            std::size_t count) {
    std::array<std::int32_t, kRates> sizes;
    for (std::size_t rate = 0; rate < kRates; ++rate) {
      const auto sum = static_cast<std::uint32_t>(sums[rate][plane]);
      const auto mean = static_cast<std::uint32_t>(std::uint64_t{sum} * kShares[count] >> 16);
      sizes[rate] = sixteenths(mean + 8);  // a thirtieth of a cell squared is always missed
    }
    const std::int32_t least = *std::min_element(sizes.begin(), sizes.end());
    std::int64_t total = 0, weighted = 0;
    const std::int32_t base = own.detail[0][plane];
    for (std::size_t rate = 0; rate < kRates; ++rate) {
      const std::int64_t credit =
          kCredit[static_cast<std::size_t>(std::min<std::int32_t>(sizes[rate] - least, 128))];
      total += credit;
      weighted += credit * (std::int64_t{own.detail[rate][plane]} - base);
    }
    return base + static_cast<std::int32_t>(weighted / total);
  }

  std::vector<State> states_;
};

}  // namespace tvg
