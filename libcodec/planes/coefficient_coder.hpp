#pragma once
#include "planes/lanes.hpp"
#include "planes/magnitude_models.hpp"
#include "planes/short_quads.hpp"
#include "prediction/pyramid.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tvg {

/// What is known of a vertex's coefficients before they are coded, [plane of the group], in cells of its own
/// lattice.
struct CoefficientForecast {
  std::uint32_t vertex;
  std::size_t count;  ///< of planes
  int shift;          ///< bits between the vertex's lattice and the fine one
  Quad rounded;       ///< the predictions, to which residuals are added
  Quad lost, size, beside, before;
  bool first;

  Expectation expected(std::size_t plane) const {
    return {static_cast<std::uint32_t>(size[plane]), static_cast<std::uint32_t>(beside[plane]),
            static_cast<std::uint32_t>(before[plane]), lost[plane], first};
  }
};

/// A coefficient on the fine lattice is within this and its negative.
inline constexpr std::int32_t kMostCoefficient = 1 << 24;

/// Codes the coefficients of a basis along the pyramid, coarse to fine, four planes at a time (format-spec
/// §7.8.2): each is predicted as the weighted mean of its neighbours. How large a residual may be is told by
/// the level, by the neighbours in the same plane, and by the planes before; all of it in shares of what is
/// usual at the level, so that planes of any energy look alike.

class CoefficientCoder {
 public:
  static constexpr std::size_t kPlanes = 4;  ///< of a group
  /// What a coder allocates, all of it when it is made: for each vertex, and beside that.
  static constexpr std::size_t kBytesPerVertex = 2 * sizeof(ShortQuad) + sizeof(std::uint16_t);
  static constexpr std::size_t most_bytes(std::size_t parts) { return parts * kBytesPerPart; }

  /// What is referred to must outlive the coder; `flags` are [vertex], empty where there is one lattice;
  /// `nested` are the bits between the two. The vertices are coded in parts, of which each has streams of its
  /// own: `ends` are the turns that they end before, each the first of its level; without any there is one.
  CoefficientCoder(const Pyramid& pyramid, std::span<const std::uint8_t> flags, int nested,
                   std::span<const std::size_t> ends = {})
      : pyramid_(&pyramid),
        flags_(flags),
        nested_(nested),
        small_(pyramid.order.size()),
        shares_(pyramid.order.size()),
        activities_(pyramid.order.size(), kWhole) {
    usual_.fill(kFirstUsual);
    parts_.resize(std::max<std::size_t>(ends.size(), 1));
    for (std::size_t part = 0; part < parts_.size(); ++part)
      parts_[part].end = ends.empty() ? pyramid.order.size() : ends[part];
  }

  /// Codes the next group of `count` planes where there is one part.
  template <class Coder, class Choose>
  bool code(Coder& coder, std::span<Quad> planes, std::size_t count, const Choose& choose) {
    begin_group(count);
    const bool inside = code_part(0, coder, planes, choose);
    end_group();
    return inside;
  }

  /// The next group has `count` planes, 1 to 4. All its parts follow, then end_group().
  void begin_group(std::size_t count) {
    count_ = count;
    all_small_ = true;
    turn_ = 0;
  }
  /// Codes the next part of a group, whose coefficients on the fine lattice are `planes`, [vertex]; they are
  /// filled in, by a decoder and by an encoder alike. `choose(models, stirs, forecast)` tells an encoder's
  /// residual. Returns false when a coefficient is out of range.
  template <class Coder, class Choose>
  bool code_part(std::size_t part, Coder& coder, std::span<Quad> planes, const Choose& choose) {
    bool inside = true;
    Part& models = parts_[part];
    for (std::size_t turn = std::exchange(turn_, models.end); turn < models.end; ++turn) {
      const std::size_t level = pyramid_->level[turn];
      if (turn == 0 || level != pyramid_->level[turn - 1]) begin_level(turn, count_);
      if (turns_at_level_ % kTurnsPerInverse == 0) take_inverses(count_);
      inside &= code_vertex(coder, models, planes, turn, count_, choose);
      ++turns_at_level_;
      if constexpr (Coder::kDecoding) {
        if (turn % 256 == 255 && coder.overrun()) return false;
      }
    }
    return inside;
  }
  /// Parts at the end may be left out.
  void end_group() {
    end_level(count_);
    usual_ = next_usual_;
    first_group_ = false;
  }

 private:
  /// What a part has by itself.
  struct Part {
    std::size_t end = 0;
    std::array<AdaptiveBit, 3 * MagnitudeModels::kLevels> stirs;
    MagnitudeModels models;
  };
  static constexpr std::size_t kBytesPerPart = sizeof(Part) + MagnitudeModels::bytes() + 256;

  static constexpr std::int32_t kWhole = 256;
  static constexpr std::int32_t kMostShare = 20 * kWhole;
  static constexpr std::int32_t kMostActivity = 6 * kWhole;
  static constexpr std::int32_t kFirstUsual = 4 << 12, kLeastUsual = 1 << 7, kMostUsual = 1 << 23;
  static constexpr std::int32_t kMostPrediction = (1 << 30) - 1;
  static constexpr std::int32_t kMostMissed = 1 << 17;  ///< in 1/64 of a cell
  static constexpr std::int32_t kRoundedMuch = 10;      ///< in 1/64 of a cell
  static constexpr std::int32_t kMostSmall = (1 << 12) - 1;
  static constexpr std::size_t kTurnsPerInverse = 16;
  static constexpr std::size_t kNearest = 8, kNearestActive = 6;

  /// [neighbours][j]: how much the size at the j-th counts, as 1 / (1 + j), in 2^-15 of them all.
  static constexpr std::array<std::array<std::int16_t, kNearest>, kNearest + 1> kNearness = [] {
    std::array<std::array<std::int16_t, kNearest>, kNearest + 1> nearness{};
    for (std::size_t count = 1; count <= kNearest; ++count) {
      std::uint32_t sum = 0;
      for (std::uint32_t j = 0; j < count; ++j) sum += 840 / (1 + j);
      for (std::uint32_t j = 0; j < count; ++j)
        nearness[count][j] = static_cast<std::int16_t>(32767 * (840 / (1 + j)) / sum);
    }
    return nearness;
  }();

  int shift_of(std::uint32_t v) const { return flags_.empty() || flags_[v] != 0 ? 0 : nested_; }

  /// What is usual at a level is expected to be what it was in the plane before, but for what the level
  /// before it has shown.
  // format-spec §7.8.3
  void begin_level(std::size_t turn, std::size_t count) {
    const std::size_t level = pyramid_->level[turn];
    if (turn > 0) end_level(count);
    Quad running{}, least{};
    for (std::size_t j = 0; j < count; ++j) {
      if (turn == 0) {
        running[j] = usual_[0];
      } else if (first_group_) {
        running[j] = running_[j] / 2;
      } else {
        const std::int64_t ratio = std::clamp<std::int64_t>(
            std::int64_t{running_[j]} * kWhole / usual_[level_], kWhole / 4, 4 * kWhole);
        running[j] =
            static_cast<std::int32_t>(std::min<std::int64_t>(usual_[level] * ratio >> 8, kMostUsual));
      }
      least[j] = kLeastUsual;
      running[j] = std::max(running[j], kLeastUsual);
    }
    running_ = Lanes(running);
    least_ = Lanes(least);
    level_ = level;
    turns_at_level_ = 0;
  }
  void end_level(std::size_t count) { next_usual_[level_] = running_[count - 1]; }

  void take_inverses(std::size_t count) {
    Quad inverse{};
    for (std::size_t j = 0; j < count; ++j) inverse[j] = (1 << 24) / running_[j];
    inverse_ = Lanes(inverse);
    most_size_ = (running_ >> 4) * Lanes::all(kMostShare / kWhole);
  }

  /// The weighted mean of a vertex's neighbours on its own lattice, in 1/64 of a cell.
  Lanes mean_of(std::size_t turn, std::span<const Quad> planes, int shift) const {
    const std::size_t at = turn * pyramid_->neighbours, count = pyramid_->count[turn];
    if (all_small_) {
      const Quad sum = weighted_sum(small_.data(), &pyramid_->neighbour[at], &pyramid_->weight[at], count);
      return (Lanes(sum) + Lanes::all(128)) >> (8 + shift);
    }
    std::array<std::int64_t, kPlanes> sum{};
    for (std::size_t i = at; i < at + count; ++i) {
      const Quad& neighbour = planes[pyramid_->neighbour[i]];
      for (std::size_t j = 0; j < kPlanes; ++j) sum[j] += std::int64_t{pyramid_->weight[i]} * neighbour[j];
    }
    Quad mean;
    for (std::size_t j = 0; j < kPlanes; ++j) {
      mean[j] = static_cast<std::int32_t>(
          std::clamp<std::int64_t>((sum[j] + 128) >> (8 + shift), -kMostPrediction, kMostPrediction));
    }
    return Lanes(mean);
  }

  /// Sizes at the nearest neighbours, the nearer the more, as shares of what is usual.
  Lanes shares_beside(std::span<const std::uint32_t> around) const {
    const std::size_t count = std::min(around.size(), kNearest);
    if (count == 0) return Lanes::all(kWhole);
    return Lanes(weighted_sum(shares_.data(), around.data(), kNearness[count].data(), count)) >> 15;
  }

  std::int32_t activity_beside(std::uint32_t v, std::span<const std::uint32_t> around) const {
    constexpr std::array<std::int32_t, kNearestActive + 1> kParts = {0,     65536, 32768, 21845,
                                                                     16384, 13107, 10922};
    const std::size_t count = std::min(around.size(), kNearestActive);
    std::int32_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += activities_[around[i]];
    return count > 0 ? sum * kParts[count] >> 16 : activities_[v];
  }

  // format-spec §7.8.2
  template <class Coder, class Choose>
  bool code_vertex(Coder& coder, Part& part, std::span<Quad> planes, std::size_t turn, std::size_t count,
                   const Choose& choose) {
    const std::uint32_t v = pyramid_->order[turn];
    const std::span<const std::uint32_t> around =
        std::span(pyramid_->neighbour).subspan(turn * pyramid_->neighbours, pyramid_->count[turn]);
    const int shift = shift_of(v);
    const Lanes predicted = mean_of(turn, planes, shift);
    const Lanes rounded = (predicted + Lanes::all(32)) >> 6;
    const Lanes lost = predicted - (rounded << 6);
    const Lanes beside = shares_beside(around), usual = running_ >> 4;
    const std::int32_t own = activities_[v], active_beside = activity_beside(v, around);
    // format-spec §7.8.3
    const Lanes share =
        Lanes::all(26) + ((beside * Lanes::all(102) + Lanes::all(77 * own + 51 * active_beside)) >> 8);
    const Lanes size = (usual * share) >> 8;
    const std::int32_t rounded_much = -sum_of(abs(lost) > kRoundedMuch);
    AdaptiveBit& stirs =
        part.stirs[3 * MagnitudeModels::level_of(static_cast<std::uint32_t>(sum_of(size >> 2))) +
                   static_cast<std::size_t>(std::min(rounded_much, 2))];
    Lanes index = rounded;
    const Lanes before = (usual * Lanes::all((154 * own + 102 * active_beside) >> 8)) >> 8;
    const CoefficientForecast forecast{v,
                                       count,
                                       shift,
                                       rounded.quad(),
                                       lost.quad(),
                                       size.quad(),
                                       (((usual >> 2) * beside) >> 6).quad(),
                                       before.quad(),
                                       first_group_};
    const Quad wanted = choose(part.models, stirs, forecast);
    if (coder.code(stirs, wanted != Quad{})) {
      Quad residuals{};
      for (std::size_t j = 0; j < count; ++j)
        residuals[j] = part.models.code(coder, forecast.expected(j), wanted[j]);
      index = index + Lanes(residuals);
    }
    const Lanes most = Lanes::all(kMostCoefficient >> shift);
    const bool inside = sum_of(abs(index) > most) == 0;
    index = max(min(index, most), Lanes::all(0) - most);
    keep(planes, v, index << shift);
    // format-spec §7.8.3
    const Lanes missed =
        min(abs(min(max(index - rounded, Lanes::all(-kMostMissed / 64)), Lanes::all(kMostMissed / 64)) *
                    Lanes::all(64) -
                lost),
            Lanes::all(kMostMissed));
    const Lanes new_size = missed << 2;
    const Lanes new_share = (min(new_size, most_size_) * inverse_) >> 12;
    const Quad shares = new_share.quad();
    for (std::size_t j = 0; j < kPlanes; ++j) shares_[v][j] = static_cast<std::int16_t>(shares[j]);
    const std::int32_t activity = sum_of(min(new_share, Lanes::all(kMostActivity))) >> 2;
    activities_[v] = static_cast<std::uint16_t>(own + ((activity - own) * 210 >> 8));
    running_ = max(running_ + (((new_size << 4) - running_) >> rate()), least_);
    return inside;
  }

  /// How slowly sizes of a level change what is usual there: 2^-rate().
  int rate() const {
    return turns_at_level_ < 8     ? 3
           : turns_at_level_ < 24  ? 4
           : turns_at_level_ < 56  ? 5
           : turns_at_level_ < 120 ? 6
                                   : 7;
  }

  /// Keeps the coefficients of a vertex; beside that, as long as all of the group are so small that no
  /// weights make a sum of more than 32 bits of them, in a form that is faster to add up.
  void keep(std::span<Quad> planes, std::uint32_t v, Lanes coefficients) {
    const Quad values = coefficients.quad();
    planes[v] = values;
    all_small_ = all_small_ && sum_of(abs(coefficients) > kMostSmall) == 0;
    for (std::size_t j = 0; j < kPlanes; ++j) small_[v][j] = static_cast<std::int16_t>(values[j]);
  }

  const Pyramid* pyramid_;
  std::span<const std::uint8_t> flags_;
  int nested_;
  bool first_group_ = true;
  bool all_small_ = true;                  ///< all that are coded of the group
  std::vector<ShortQuad> small_;           ///< [vertex] coefficients of this group
  std::vector<ShortQuad> shares_;          ///< [vertex] sizes in this group, as shares of what is usual
  std::vector<std::uint16_t> activities_;  ///< [vertex] such shares, of the groups before too
  std::array<std::int32_t, 256> usual_{};  ///< [level] size in the last plane, in 1/4096 of a cell
  std::array<std::int32_t, 256> next_usual_{};
  std::size_t level_ = 0, turns_at_level_ = 0;
  Lanes running_, inverse_;  ///< of the level: sizes in 1/4096 of a cell, 2^24 over them
  Lanes least_, most_size_;  ///< 0 in lanes without a plane
  std::vector<Part> parts_;
  std::size_t count_ = 0, turn_ = 0;  ///< of the group: its planes, and the turn that is next
};

}  // namespace tvg
