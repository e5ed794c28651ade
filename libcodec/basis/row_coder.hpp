#pragma once
#include "basis/least_squares.hpp"
#include "basis/row_models.hpp"
#include "entropy/adaptive_models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// Predicts and codes the rows of a basis, frame by frame (format-spec §7.8.4). Written once for both
/// directions. Several experts say what a value will be, of the frames before, of a frame before that was
/// alike and of the rows already coded in this frame; those count most that missed least.
class RowCoder {
 public:
  /// Bounds of values, and of their negatives.
  static constexpr std::int32_t kMostValue = 1 << 26;

  /// What a coder of so many rows allocates, all of it when it is made.
  static constexpr std::size_t bytes(std::size_t rows) {
    return rows * (sizeof(Row) + sizeof(Motion) + kFrames * kAxes * sizeof(std::int32_t));
  }

  /// The scale of each row (§7.8), from which follows how large its values are beside those of the others.
  explicit RowCoder(std::span<const std::uint8_t> scales)
      : rows_(scales.size()), after_(scales.size()), past_(kFrames * kAxes * scales.size()) {
    for (std::size_t a = 0; a < scales.size(); ++a)
      rows_[a].step = static_cast<double>(4 + (scales[a] & 3)) *
                      static_cast<double>(std::uint64_t{1} << (scales[a] >> 2));
  }

  /// Codes the values of the next frame, [row][axis]; a decoder fills them in. Returns false, with the coder
  /// of no use any more, when one is out of bounds or the stream is damaged. (Whether the stream ends here,
  /// the caller asks the decoder.)
  template <class Coder>
  bool code_frame(Coder& coder, std::span<std::int32_t> values) {
    if constexpr (!Coder::kDecoding) {
      for (const std::int32_t value : values) {
        if (value < -kMostValue || value > kMostValue) return false;
      }
    }
    if (!code_alike(coder, values)) return false;
    tells_.fill(nullptr);
    for (std::size_t i = 0; i < 4 && frames_ > 0; ++i) tells_[i] = values_back(i + 1);
    for (std::size_t i = 4; i < 6 && alike_ > 0; ++i) tells_[i] = values_back(alike_ + i - 4);
    gather_after();
    Motion before{};
    frame_ = {};
    for (std::size_t a = 0; a < rows_.size(); ++a) {
      if (!code_row(coder, a, before, values.subspan(kAxes * a, kAxes))) return false;
      if constexpr (Coder::kDecoding) {
        if (coder.overrun()) return false;
      }
    }
    std::copy(values.begin(), values.end(), past(frames_).begin());
    ++frames_;
    return true;
  }

 private:
  static constexpr std::size_t kAxes = 3;
  static constexpr std::size_t kFrames = 64;  ///< that are remembered
  static constexpr std::size_t kExperts = 6;
  enum Expert : std::size_t { kZero, kLast, kCurved, kLearnt, kLearntAlike, kAlong };

  /// Values of the last four frames, of the frame alike and of that before it.
  using Motion = LeastSquares<6>;
  /// Steps between these, of which the rows before in the same frame tell what they come to.
  using Course = LeastSquares<5>;

  struct Row {
    double step = 1;
    std::array<double, kExperts> missed{};  ///< mean size of what each expert missed
    std::array<double, kAxes> size{};       ///< mean size of what was coded
    Motion motion;
  };

  /// What is known of the frame from the rows before.
  struct Frame {
    Course course;
    double found = 1;  ///< sizes met, over those expected
    double count = 1;
    double level = 0;  ///< in the first frame: mean size times step
    double levels = 0;
  };

  /// One axis of a row before it is coded.
  struct Axis {
    Motion::Numbers values;
    Course::Numbers steps;
    std::array<double, kExperts> expected;
  };

  static double rate(std::size_t count, double least) {
    return std::max(1.0 / static_cast<double>(count), least);
  }
  static std::int64_t floor_of(double value) {
    const auto cut = static_cast<std::int64_t>(value);
    return cut - (static_cast<double>(cut) > value ? 1 : 0);
  }
  static double bounded(double value) {
    return value > -kMostValue ? value < kMostValue ? value : kMostValue : -kMostValue;
  }

  std::span<std::int32_t> past(std::size_t frame) {
    const std::size_t values = kAxes * rows_.size();
    return std::span(past_).subspan(frame % kFrames * values, values);
  }
  /// The values so many frames back, 1 for the last; those of the first frame before there was one.
  const std::int32_t* values_back(std::size_t back) { return past(frames_ - std::min(back, frames_)).data(); }

  /// Codes which frame was alike, if any.
  template <class Coder>
  bool code_alike(Coder& coder, std::span<const std::int32_t> values) {
    alike_ = 0;
    if (frames_ < 3) return true;
    if constexpr (!Coder::kDecoding) alike_ = most_alike(values);
    if (!coder.code(is_alike_, alike_ > 0)) {
      alike_ = 0;
      return true;
    }
    alike_ = 2 + coder.code_raw(static_cast<std::uint32_t>(alike_ - 2), 6);
    return alike_ < std::min(frames_, kFrames);
  }

  /// How many frames back the motion was most like that to the frame to be coded; 0 where it nowhere was.
  std::size_t most_alike(std::span<const std::int32_t> values) {
    const std::span<const std::int32_t> last = past(frames_ - 1);
    double least = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      least += apart(i, static_cast<double>(values[i]) - last[i]);
    least *= 0.85;
    std::size_t best = 0;
    for (std::size_t back = 2; back < std::min(frames_, kFrames); ++back) {
      const std::span<const std::int32_t> to = past(frames_ - back), from = past(frames_ - back - 1);
      double sum = 0;
      for (std::size_t i = 0; i < values.size() && sum < least; ++i)
        sum += apart(i, (static_cast<double>(values[i]) - last[i]) - (static_cast<double>(to[i]) - from[i]));
      if (sum < least) {
        least = sum;
        best = back;
      }
    }
    return best;
  }
  double apart(std::size_t at, double difference) const {
    return std::min(4.0, std::abs(difference) / (0.5 + rows_[at / kAxes].size[at % kAxes]));
  }

  /// For each row, what was learnt at those after it, the nearer the more.
  void gather_after() {
    Motion sum{};
    for (std::size_t a = rows_.size(); a-- > 0;) {
      sum.fade(kNearness);
      after_[a] = sum;
      sum.add(rows_[a].motion);
    }
  }

  template <class Coder>
  bool code_row(Coder& coder, std::size_t a, Motion& before, std::span<std::int32_t> values) {
    Row& row = rows_[a];
    before.fade(kNearness);
    std::array<Axis, kAxes> axes;
    expect(a, before, axes);
    const std::array<double, kExperts> credits = credits_of(row);
    const double usual = usual_size(a);
    row.motion.fade(0.92);
    frame_.course.fade(0.8);
    std::array<double, kExperts> missed{};
    for (std::size_t k = 0; k < kAxes; ++k) {
      const Axis& axis = axes[k];
      double total = 0, sum = 0;
      for (std::size_t e = 0; e < kExperts; ++e) {
        total += credits[e];
        sum += credits[e] * axis.expected[e];
      }
      const double predicted = bounded(sum / total);
      const double size = expected_size(a, k, usual);
      const auto fine = floor_of(predicted * 64.0 + 0.5);
      const auto rounded = static_cast<std::int32_t>((fine + 32) >> 6);
      const auto lost = static_cast<std::int32_t>(fine - std::int64_t{rounded} * 64);
      const std::int32_t residual = models_.code(coder, static_cast<std::uint32_t>(size * 256.0), lost,
                                                 Coder::kDecoding ? 0 : values[k] - rounded);
      const std::int32_t value = rounded + residual;
      if (value < -kMostValue || value > kMostValue) return false;
      values[k] = value;
      const double off = std::abs(value - predicted);
      learn(row, axis, k, value, off, size);
      for (std::size_t e = 0; e < kExperts; ++e) missed[e] += std::abs(value - axis.expected[e]);
    }
    if (frames_ == 0) row.missed[kZero] = missed[kZero] / 3.0;
    for (std::size_t e = 0; e < kExperts && frames_ > 0; ++e)
      row.missed[e] += (missed[e] / 3.0 - row.missed[e]) * rate(frames_, 0.2);
    before.add(row.motion);
    return true;
  }

  void expect(std::size_t a, const Motion& before, std::array<Axis, kAxes>& axes) {
    Motion motion = before;
    motion.add(rows_[a].motion);
    motion.add(after_[a]);
    const bool alike = alike_ > 0;
    Motion::Numbers drawn{};
    drawn[0] = frames_ < 2 ? 1.0 : 1.6;
    drawn[1] = frames_ < 2 ? 0.0 : -0.7;
    const Motion::Solution solved(motion, 0.5, drawn, alike ? 6 : 4);
    const Motion::Numbers learnt = solved.factors(4), learnt_alike = solved.factors(alike ? 6 : 4);
    const Course::Numbers course =
        Course::Solution(frame_.course, 0.3, Course::Numbers{}, alike ? 5 : 3).factors(alike ? 5 : 3);
    for (std::size_t k = 0; k < kAxes; ++k) {
      Axis& axis = axes[k];
      const std::size_t at = kAxes * a + k;
      Motion::Numbers& x = axis.values;
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = tells_[i] != nullptr ? tells_[i][at] : 0.0;
      axis.steps = {x[0] - x[1], x[1] - x[2], x[2] - x[3], alike ? x[4] - x[0] : 0.0, x[4] - x[5]};
      axis.expected[kZero] = 0.0;
      axis.expected[kLast] = x[0];
      axis.expected[kCurved] = frames_ < 3 ? 2.0 * x[0] - x[1] : 3.0 * (x[0] - x[1]) + x[2];
      axis.expected[kLearnt] = bounded(scalar(learnt, x));
      axis.expected[kLearntAlike] = alike ? bounded(scalar(learnt_alike, x)) : axis.expected[kLearnt];
      axis.expected[kAlong] = bounded(axis.expected[kLearntAlike] + scalar(course, axis.steps));
    }
  }
  template <std::size_t N>
  static double scalar(const std::array<double, N>& a, const std::array<double, N>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < N; ++i) sum += a[i] * b[i];
    return sum;
  }

  /// How much each expert counts.
  std::array<double, kExperts> credits_of(const Row& row) const {
    std::array<double, kExperts> credits{};
    for (std::size_t e = 0; e < kExperts; ++e) {
      const double credit = 1.0 / (0.02 + row.missed[e] * row.missed[e]);
      credits[e] = credit * credit;
    }
    if (alike_ == 0) credits[kLearntAlike] = 0.0;
    return credits;
  }

  /// Mean size of what was coded at a row and at those next to it.
  double usual_size(std::size_t a) const {
    double near = 0;
    const std::size_t first = a - std::min<std::size_t>(a, 3), last = std::min(a + 3, rows_.size() - 1);
    for (std::size_t b = first; b <= last; ++b)
      near += rows_[b].size[0] + rows_[b].size[1] + rows_[b].size[2];
    const double own = rows_[a].size[0] + rows_[a].size[1] + rows_[a].size[2];
    return 0.1 * own + 0.1 * (near / static_cast<double>(last - first + 1));
  }

  double expected_size(std::size_t a, std::size_t k, double usual) {
    const Row& row = rows_[a];
    double size = 0;
    if (frames_ == 0) {
      size = a == 0 ? 16384.0 : frame_.levels == 0 ? 1024.0 : 0.5 + frame_.level / row.step;
    } else if (frames_ == 1) {
      size = (0.1 * row.size[k] + 0.1 * (row.size[0] + row.size[1] + row.size[2]) + 2.0) *
             (frame_.found / frame_.count);
    } else {
      size = (0.4 * row.size[k] + usual + 0.1) * (frame_.found / frame_.count);
    }
    return std::clamp(size, 0.02, 65535.0);
  }

  void learn(Row& row, const Axis& axis, std::size_t k, double value, double off, double size) {
    if (frames_ == 0) {
      if (&row != rows_.data()) {
        frame_.levels += 1.0;
        frame_.level += (off * row.step - frame_.level) * std::max(1.0 / frame_.levels, 0.1);
      }
      row.size[k] = off;
      return;
    }
    frame_.found = frame_.found * 0.97 + std::min(4.0, off / size);
    frame_.count = frame_.count * 0.97 + 1.0;
    if (frames_ > 1) frame_.course.take(axis.steps, value - axis.expected[kLearntAlike], 1.0 / (size * size));
    row.motion.take(axis.values, value, 1.0 / (0.3 + size * size));
    row.size[k] = frames_ == 1 ? off : row.size[k] + (off - row.size[k]) * rate(frames_, 0.3);
  }

  static constexpr double kNearness = 0.6;

  std::size_t frames_ = 0;
  std::size_t alike_ = 0;  ///< how many frames back one was alike, 0 if none
  AdaptiveBit is_alike_;
  std::vector<Row> rows_;
  std::vector<Motion> after_;
  std::vector<std::int32_t> past_;  ///< [frame % kFrames][row][axis]
  /// Where the values that tell of those of this frame are, nullptr for zeros.
  std::array<const std::int32_t*, 6> tells_{};
  Frame frame_;
  RowModels models_;
};

}  // namespace tvg
