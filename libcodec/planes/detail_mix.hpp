#pragma once
#include "planes/reals.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// What a vertex is expected to miss the mean of its neighbours by, where the numbers are real (format-spec
// §7.9.3): four opinions of it, and which of them to believe.
namespace tvg {

/// The opinions on all vertices, and the errors that they had.
class DetailMix {
 public:
  static constexpr std::size_t kOpinions = 4;
  using Opinions = std::array<Reals, kOpinions>;
  static constexpr std::size_t kBytesPerVertex = 2 * sizeof(Opinions);

  explicit DetailMix(std::size_t vertex_count) : states_(vertex_count) {}

  /// What the frames before make of a vertex.
  const Opinions& opinions(std::uint32_t v) const { return states_[v].detail; }

  /// The mean of opinions on a vertex, each weighted by the inverse fourth power of its error here and at the
  /// nearest neighbours.
  Reals expected(std::uint32_t v, std::span<const std::uint32_t> around, const Opinions& opinions) const {
    Opinions errors;
    for (std::size_t i = 0; i < kOpinions; ++i) errors[i] = Reals::all(1.25) * states_[v].error[i];
    for (const std::uint32_t q : around.first(std::min(around.size(), kNearest))) {
      for (std::size_t i = 0; i < kOpinions; ++i) errors[i] = errors[i] + states_[q].error[i];
    }
    Reals total{}, weighted{};
    for (std::size_t i = 0; i < kOpinions; ++i) {
      const Reals inverse = Reals::all(1) / (errors[i] + Reals::all(kNoError));
      const Reals square = inverse * inverse, credit = square * square;
      total = total + credit;
      weighted = weighted + credit * opinions[i];
    }
    return weighted / total;
  }

  /// Takes what the detail was on which there were these opinions, in a frame of which so many came before it
  /// in the GOP.
  void take(std::uint32_t v, const Opinions& opinions, Reals detail, std::uint32_t frames_before) {
    State& state = states_[v];
    for (std::size_t i = 0; i < kOpinions; ++i) {
      const Reals missed = abs(detail - opinions[i]);
      Reals& error = state.error[i];
      // What the first frame's opinions were worth says nothing of those of later frames.
      error = frames_before < 2 ? missed : error + (missed - error) * Reals::all(0.375);
    }
    if (frames_before == 0) {
      state.detail.fill(detail);
      return;
    }
    const double slow = kSlow[std::min<std::size_t>(frames_before, kSlow.size() - 1)];
    auto& [last, quarter, mean, going_on] = state.detail;
    going_on = detail + detail - last;
    last = detail;
    quarter = quarter + (detail - quarter) * Reals::all(0.25);
    mean = mean + (detail - mean) * Reals::all(slow);
  }

 private:
  static constexpr std::size_t kNearest = 4;
  static constexpr double kNoError = 0x1p-160;
  /// [frames before] one over the number of frames there are with this one, at most ten.
  static constexpr std::array<double, 10> kSlow = {1,       1.0 / 2, 1.0 / 3, 1.0 / 4, 1.0 / 5,
                                                   1.0 / 6, 1.0 / 7, 1.0 / 8, 1.0 / 9, 1.0 / 10};

  struct State {
    Opinions detail{};  ///< the last, two means that forget, and the last two carried on
    Opinions error{};   ///< mean absolute
  };

  std::vector<State> states_;
};

}  // namespace tvg
