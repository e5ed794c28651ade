#pragma once
#include "planes/detail_blend.hpp"
#include "planes/lanes.hpp"
#include "planes/magnitude_models.hpp"
#include "prediction/pyramid.hpp"
#include "quantization/lattice.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tvg {

/// Predicts and codes positions along the pyramid, coarse to fine (format-spec §7.7): a vertex is predicted
/// as the weighted mean of its neighbours in the same frame and the detail that is expected of it, which is
/// how it missed that mean in the frames before. Written once for both directions, as PlaneCoder; which holds
/// the planes.
class PyramidCoder {
 public:
  /// What a coder allocates, all of it when it is made: for each vertex, and beside that.
  static constexpr std::size_t kBytesPerVertex = DetailBlend::kBytesPerVertex + 2 * sizeof(Quad);
  static constexpr std::size_t kMostOtherBytes = MagnitudeModels::bytes() + 256 * sizeof(Quad);

  /// What is referred to must outlive the coder; `flags` are [vertex], empty when the lattice is not hybrid.
  PyramidCoder(const Pyramid& pyramid, std::span<const std::uint8_t> flags, const Lattice& lattice)
      : pyramid_(&pyramid),
        flags_(flags),
        bits_(lattice.fine_bits),
        nested_(lattice.shift()),
        details_(pyramid.order.size()),
        sizes_(pyramid.order.size(), all(2 * kCell)),
        sizes_before_(sizes_),
        level_sizes_(256, all(2 * kCell * 16)) {}

  /// Codes a frame whose indices on the fine lattice are `planes`; a decoder fills them in. Returns false
  /// when a decoded index lies outside its lattice.
  template <class Coder>
  bool code(Coder& coder, std::span<Quad> planes) {
    std::uint32_t outside = 0;
    sizes_.swap(sizes_before_);
    for (std::size_t turn = 0; turn < pyramid_->order.size(); ++turn) {
      outside |= code_vertex(coder, planes, turn);
      if constexpr (Coder::kDecoding) {
        if (turn % 256 == 255 && coder.overrun()) return false;
      }
    }
    ++frames_;
    return outside == 0;
  }

  /// Takes note of a frame that was coded otherwise.
  void follow(std::span<const Quad> planes) {
    for (std::size_t turn = 0; turn < pyramid_->order.size(); ++turn) {
      const std::uint32_t v = pyramid_->order[turn];
      const int shift = shift_of(v);
      take_details(v, shifted(planes[v], shift), mean_of(turn, planes, shift));
    }
    ++frames_;
  }

 private:
  static constexpr std::int32_t kCell = 256;  ///< sizes are in so many parts of a cell
  static constexpr std::int32_t kMostSize = 1 << 20;
  /// Bounds of means and of details, so that sums and differences stay within 32 bits. Means of indices of 24
  /// bits reach the first in valid streams, details the second in damaged ones only.
  static constexpr std::int32_t kMostMean = (1 << 30) - 1;
  static constexpr std::int32_t kMostDetail = 1 << 29;
  /// 4096 / (1 + j): how much the size at the j-th neighbour counts.
  static constexpr std::array<std::int32_t, 8> kNearness = {4096, 2048, 1365, 1024, 819, 682, 585, 512};

  static constexpr Quad all(std::int32_t value) { return {value, value, value, 0}; }
  static Quad shifted(const Quad& quad, int shift) { return (Lanes(quad) >> shift).quad(); }
  int shift_of(std::uint32_t v) const { return flags_.empty() || flags_[v] != 0 ? 0 : nested_; }

  /// Of the vertex with this turn, nearest first.
  std::span<const std::uint32_t> neighbours(std::size_t turn) const {
    return std::span(pyramid_->neighbour).subspan(turn * pyramid_->neighbours, pyramid_->count[turn]);
  }

  /// The weighted mean of a vertex's neighbours on its own lattice, `shift` bits from the fine one, in 1/64
  /// of a cell.
  // format-spec §7.7.2
  Quad mean_of(std::size_t turn, std::span<const Quad> planes, int shift) const {
    const std::span<const std::uint32_t> around = neighbours(turn);
    const std::int16_t* const weights = pyramid_->weight.data() + turn * pyramid_->neighbours;
    std::array<std::int64_t, 3> sum{};
    for (std::size_t j = 0; j < around.size(); ++j) {
      const Quad& at = planes[around[j]];
      for (std::size_t plane = 0; plane < 3; ++plane)
        sum[plane] += std::int64_t{weights[j]} * (at[plane] >> shift);
    }
    Quad mean{};
    for (std::size_t plane = 0; plane < 3; ++plane)
      mean[plane] =
          static_cast<std::int32_t>(std::clamp<std::int64_t>((sum[plane] + 128) >> 8, -kMostMean, kMostMean));
    return mean;
  }

  // format-spec §7.7.3
  void take_details(std::uint32_t v, const Quad& index, const Quad& mean) {
    Quad details{};
    for (std::size_t plane = 0; plane < 3; ++plane)
      details[plane] = std::clamp((index[plane] << kDetailBits) - mean[plane], -kMostDetail, kMostDetail);
    details_.take(v, details, frames_);
  }

  /// Where the first vertex of a GOP, or one without neighbours, is expected.
  Quad start(std::size_t turn, std::span<const Quad> planes, int shift) const {
    if (turn == 0) return all((1 << (bits_ - 1) >> shift) << kDetailBits);
    return (Lanes(shifted(planes[pyramid_->order[turn - 1]], shift)) << kDetailBits).quad();
  }

  // format-spec §7.7.1
  template <class Coder>
  std::uint32_t code_vertex(Coder& coder, std::span<Quad> planes, std::size_t turn) {
    const std::uint32_t v = pyramid_->order[turn];
    const std::span<const std::uint32_t> around = neighbours(turn);
    const int shift = shift_of(v);
    const bool first = frames_ == 0;
    const Quad mean = mean_of(turn, planes, shift);
    Quad predicted = mean;
    if (!first) {
      predicted = (Lanes(mean) + Lanes(details_.expected(v, around))).quad();
      for (std::int32_t& value : predicted) value = std::clamp(value, -kMostMean, kMostMean);
    } else if (around.empty()) {
      predicted = start(turn, planes, shift);
    }
    const Quad wanted = shifted(planes[v], shift);
    const std::int32_t last = (1 << (bits_ - shift)) - 1;
    Quad& level = level_sizes_[pyramid_->level[turn]];
    Quad beside = sizes_beside(around);
    if (around.empty()) beside = level_size(level);
    Quad index{};
    std::uint32_t outside = 0;
    std::int32_t earlier = 0;  // sizes of the planes before this one
    for (std::size_t plane = 0; plane < 3; ++plane) {
      const std::int32_t rounded = std::clamp((predicted[plane] + 32) >> kDetailBits, 0, last);
      Expectation known;
      known.first = first;
      known.beside = static_cast<std::uint32_t>(beside[plane]);
      const std::int32_t other = plane == 0 ? beside[plane] : earlier / static_cast<std::int32_t>(plane);
      known.before = static_cast<std::uint32_t>(first ? other : sizes_before_[v][plane]);
      known.size = expected_size(level[plane] >> 4, beside[plane], sizes_before_[v][plane], other, first,
                                 around.empty());
      known.lost = std::clamp(predicted[plane] - (rounded << kDetailBits), -32, 32);
      const std::int32_t residual =
          models_.code(coder.lane(plane), known, Coder::kDecoding ? 0 : wanted[plane] - rounded);
      const std::int32_t value = rounded + residual;
      index[plane] = value & last;
      outside |= static_cast<std::uint32_t>(value ^ index[plane]);
      const std::int32_t missed =
          std::clamp((index[plane] << kDetailBits) - predicted[plane], -kMostSize / 4, kMostSize / 4);
      const std::int32_t size = (missed < 0 ? -missed : missed) * 4;
      sizes_[v][plane] = size;
      earlier += size;
      level[plane] += ((size << 4) - level[plane]) >> 6;
    }
    if constexpr (Coder::kDecoding) planes[v] = (Lanes(index) << shift).quad();
    take_details(v, index, mean);
    return outside;
  }

  static Quad level_size(const Quad& level) { return (Lanes(level) >> 4).quad(); }

  /// Sizes at the nearest neighbours, the nearer the more.
  Quad sizes_beside(std::span<const std::uint32_t> around) const {
    std::array<std::int64_t, 3> sum{};
    std::int64_t total = 0;
    for (std::size_t j = 0; j < std::min(around.size(), kNearness.size()); ++j) {
      const Quad& at = sizes_[around[j]];
      for (std::size_t plane = 0; plane < 3; ++plane) sum[plane] += std::int64_t{kNearness[j]} * at[plane];
      total += kNearness[j];
    }
    Quad sizes{};
    for (std::size_t plane = 0; plane < 3 && total > 0; ++plane)
      sizes[plane] = static_cast<std::int32_t>(sum[plane] / total);
    return sizes;
  }

  // format-spec §7.7.4
  static std::uint32_t expected_size(std::int32_t level, std::int32_t beside, std::int32_t before,
                                     std::int32_t other, bool first, bool alone) {
    if (first && alone) return 200 * kCell;
    if (first) return static_cast<std::uint32_t>((level + beside) / 2);
    return static_cast<std::uint32_t>((std::int64_t{38} * level + std::int64_t{90} * beside +
                                       std::int64_t{77} * before + std::int64_t{51} * other) >>
                                      8);
  }

  const Pyramid* pyramid_;
  std::span<const std::uint8_t> flags_;
  int bits_;    ///< of the fine lattice
  int nested_;  ///< bits between the two lattices
  std::uint32_t frames_ = 0;
  DetailBlend details_;
  std::vector<Quad> sizes_;         ///< of residuals of this frame, where coded, in 1/256 of a cell
  std::vector<Quad> sizes_before_;  ///< of the frame before
  std::vector<Quad> level_sizes_;   ///< [level] running mean, in 1/4096 of a cell
  MagnitudeModels models_;
};

}  // namespace tvg
