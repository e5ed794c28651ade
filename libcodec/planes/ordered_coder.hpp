#pragma once
#include "planes/detail_mix.hpp"
#include "planes/length_models.hpp"
#include "planes/reals.hpp"
#include "planes/reference_shape.hpp"
#include "prediction/pyramid.hpp"
#include "quantization/number_line.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tvg {

/// Predicts and codes float32 positions along the pyramid, so that every bit of them comes back (format-spec
/// §7.9): predictions are real numbers, residuals those of the places on a line of numbers. Written once for
/// both directions.
class OrderedCoder {
 public:
  /// What a coder allocates, all of it when it is made: for each vertex, and beside that.
  static constexpr std::size_t kBytesPerVertex = DetailMix::kBytesPerVertex + 16;
  static constexpr std::size_t kMostOtherBytes = LengthModels::bytes() + 4096;

  /// What is referred to must outlive the coder; the shape is that of the pyramid.
  OrderedCoder(const Pyramid& pyramid, const ReferenceShape& shape, const NumberLine& line)
      : pyramid_(&pyramid),
        shape_(&shape),
        line_(line),
        details_(pyramid.order.size()),
        sizes_(pyramid.order.size()) {
    for (Logs& level : levels_) level.fill(log_sixteenths(shape.step) << 4);
  }

  /// Codes a frame of these values, [vertex], all on the line; a decoder fills them in. Returns false when a
  /// decoded value lies beyond the ends of the line.
  template <class Coder>
  bool code(Coder& coder, std::span<Reals> values) {
    for (std::size_t turn = 0; turn < pyramid_->order.size(); ++turn) {
      if (!code_vertex(coder, values, turn)) return false;
      if constexpr (Coder::kDecoding) {
        if (turn % 256 == 255 && coder.overrun()) return false;
      }
    }
    ++frames_;
    return true;
  }

 private:
  using Logs = std::array<std::int32_t, 3>;
  static constexpr std::size_t kMostLevels = 128;  ///< more than a pyramid has
  /// A size that counts as none: four octaves below a step.
  static constexpr std::int32_t kLeastSize = -64;
  /// How much the size at the j-th neighbour counts, and 2^16 over the sum of the first j.
  static constexpr std::array<std::int32_t, 8> kNearness = {16, 8, 5, 4, 3, 3, 2, 2};
  static constexpr std::array<std::int32_t, 9> kShares = {0, 4096, 2730, 2259, 1985, 1820, 1680, 1598, 1524};

  /// What predictions of a vertex missed: log_sixteenths() of it in this frame, where coded, and in the frame
  /// before, and whether the vertex lay below (0), at (1) or above (2) its prediction.
  struct Sizes {
    std::array<std::int16_t, 3> now{}, before{};
    std::array<std::uint8_t, 3> side{1, 1, 1};
  };
  static_assert(sizeof(Sizes) <= 16);

  /// Of the vertex with this turn, nearest first.
  std::span<const std::uint32_t> neighbours(std::size_t turn) const {
    return std::span(pyramid_->neighbour).subspan(turn * pyramid_->neighbours, pyramid_->count[turn]);
  }

  /// The weighted mean of what the neighbours of the vertex with this turn have.
  // format-spec §7.9.3
  template <class ValueOf>
  Reals mean_of(std::size_t turn, const ValueOf& value_of) const {
    const std::span<const std::uint32_t> around = neighbours(turn);
    const std::int16_t* const weights = pyramid_->weight.data() + turn * pyramid_->neighbours;
    Reals sum{};
    for (std::size_t j = 0; j < around.size(); ++j) sum = sum + Reals::all(weights[j]) * value_of(around[j]);
    return sum * Reals::all(0x1p-14);
  }

  /// Where the reference shape has a vertex.
  Reals shape_at(std::uint32_t v) const {
    constexpr double kLargest = std::numeric_limits<float>::max();
    const auto on_axis = [&](std::size_t axis) {
      return std::clamp(shape_->origin[axis] + (shape_->indices[v][axis] + 0.5) * shape_->step, -kLargest,
                        kLargest);
    };
    return {on_axis(0), on_axis(1), on_axis(2), 0};
  }

  /// In the first frame: that the vertex lies where the shape has it, that it lies to its neighbours as it
  /// does there, and that it lies in their mean.
  DetailMix::Opinions first_opinions(std::size_t turn, const Reals& mean) const {
    const Reals shape = shape_at(pyramid_->order[turn]);
    const Reals here = shape - mean;
    if (pyramid_->count[turn] == 0) return {here, here, here, here};
    return {here, shape - mean_of(turn, [this](std::uint32_t q) { return shape_at(q); }), Reals(), here};
  }

  // format-spec §7.9.2
  template <class Coder>
  bool code_vertex(Coder& coder, std::span<Reals> values, std::size_t turn) {
    const std::uint32_t v = pyramid_->order[turn];
    const std::span<const std::uint32_t> around = neighbours(turn);
    const Reals mean = mean_of(turn, [values](std::uint32_t q) { return values[q]; });
    const DetailMix::Opinions opinions = frames_ == 0 ? first_opinions(turn, mean) : details_.opinions(v);
    const Reals prediction = mean + details_.expected(v, around, opinions);
    sizes_[v].before = sizes_[v].now;
    std::array<double, 3> coded{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double predicted = prediction[axis];
      const std::int64_t place = line_.place_between(predicted);
      const auto rounded = static_cast<std::int32_t>((place + (1 << (NumberLine::kFractionBits - 1))) >>
                                                     NumberLine::kFractionBits);
      LengthExpectation known = expectation(turn, axis, predicted);
      known.lost = static_cast<std::int32_t>(place - (std::int64_t{rounded} << NumberLine::kFractionBits));
      const std::uint32_t wanted = Coder::kDecoding
                                       ? 0
                                       : static_cast<std::uint32_t>(line_.place_of(values[v][axis])) -
                                             static_cast<std::uint32_t>(rounded);
      const auto number = static_cast<std::int32_t>(static_cast<std::uint32_t>(rounded) +
                                                    models_.code(coder.lane(axis), known, wanted));
      if (number < -1 - line_.most() || number > line_.most()) return false;
      coded[axis] = line_.value_at(number);
      learn_size(turn, axis, coded[axis] - predicted);
    }
    if constexpr (Coder::kDecoding) values[v] = Reals(coded[0], coded[1], coded[2], 0);
    details_.take(v, opinions, values[v] - mean, frames_);
    return true;
  }

  // format-spec §7.9.4
  LengthExpectation expectation(std::size_t turn, std::size_t axis, double predicted) const {
    const std::span<const std::uint32_t> around = neighbours(turn);
    const Sizes& own = sizes_[pyramid_->order[turn]];
    const std::int32_t step = line_.log_step(predicted);
    const auto in_steps = [step](std::int32_t size) { return std::max(size - step, kLeastSize); };
    LengthExpectation known;
    known.first = frames_ == 0;
    const std::int32_t usual = in_steps(levels_[pyramid_->level[turn]][axis] >> 4);
    const std::size_t count = std::min(around.size(), kNearness.size());
    std::int32_t sum = 0;
    for (std::size_t j = 0; j < count; ++j) sum += kNearness[j] * in_steps(sizes_[around[j]].now[axis]);
    known.beside = count > 0 ? (sum * kShares[count]) >> 16 : usual;
    const std::int32_t other = axis == 0   ? known.beside
                               : axis == 1 ? in_steps(own.now[0])
                                           : (in_steps(own.now[0]) + in_steps(own.now[1])) >> 1;
    known.before = known.first ? other : in_steps(own.before[axis]);
    known.size = known.first ? (usual + known.beside) >> 1
                             : (38 * usual + 90 * known.beside + 77 * known.before + 51 * other) >> 8;
    const auto side = [&](std::size_t j) -> std::size_t {
      return j < around.size() ? sizes_[around[j]].side[axis] : 1;
    };
    known.signs = 9 * side(0) + 3 * side(1) + own.side[axis];
    return known;
  }

  void learn_size(std::size_t turn, std::size_t axis, double missed) {
    Sizes& own = sizes_[pyramid_->order[turn]];
    const std::int32_t size = log_sixteenths(missed);
    own.now[axis] = static_cast<std::int16_t>(size);
    own.side[axis] = missed < 0 ? 0 : missed > 0 ? 2 : 1;
    std::int32_t& level = levels_[pyramid_->level[turn]][axis];
    level += ((size << 4) - level) >> 6;
  }

  const Pyramid* pyramid_;
  const ReferenceShape* shape_;
  NumberLine line_;
  std::uint32_t frames_ = 0;
  DetailMix details_;
  std::vector<Sizes> sizes_;
  std::array<Logs, kMostLevels> levels_{};  ///< [level] running mean of log_sixteenths(), in 1/16
  LengthModels models_;
};

}  // namespace tvg
