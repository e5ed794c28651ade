#pragma once
#include "planes/lanes.hpp"
#include "planes/shape_models.hpp"
#include "planes/shape_order.hpp"
#include "planes/shape_reach.hpp"
#include "planes/shape_surroundings.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace tvg {

/// Codes the positions of a reference shape (format-spec §5.3), for both directions: with a RangeEncoder
/// given positions are written, with a RangeDecoder they are read.
class ShapeCoder {
 public:
  /// What is known of a vertex: all zero before it is coded.
  struct Coded {
    Quad position;  ///< x, y, z, 1
    Quad size;      ///< of the residuals
  };
  using Position = std::array<std::int32_t, 3>;

  static constexpr std::size_t kBytesPerVertex =
      ShapeSurroundings::kBytesPerVertex + ShapeOrder::kBytesPerVertex + sizeof(Coded);
  static constexpr std::size_t kBytesPerFace = ShapeSurroundings::kBytesPerFace;
  static constexpr std::size_t kModelBytes = sizeof(ShapeModels);

  ShapeCoder(std::span<const Face> faces, std::uint32_t vertex_count, int bits)
      : surroundings_(faces, vertex_count),
        order_(vertex_count),
        last_index_((std::int32_t{1} << bits) - 1),
        coded_(vertex_count, Coded{}),
        reach_(bits),
        models_(std::make_unique<ShapeModels>()) {
    running_.fill(std::int64_t{1} << bits);
  }

  /// Codes `positions` ([vertex]), all of them on the lattice when encoding. Returns false when the stream is
  /// damaged.
  template <class Coder>
  bool code(Coder& coder, std::span<Position> positions) {
    for (std::size_t turn = 0; turn < positions.size(); ++turn) {
      const std::uint32_t v = order_.next();
      if (!code_vertex(coder, v, positions[v])) return false;
      if constexpr (Coder::kDecoding) {
        if (turn % 256 == 255 && coder.overrun())
          return false;  // work in proportion to the bytes that are there
      }
    }
    return true;
  }

 private:
  static constexpr std::size_t kMostRing = 64, kMostWings = 12;

  /// A sum of positions, to be divided by their number.
  struct Guess {
    Quad sum;
    std::int32_t wings;  ///< parallelograms that it comes from

    std::int32_t count() const { return sum[3]; }
  };

  // format-spec §5.3.3
  template <class Coder>
  bool code_vertex(Coder& coder, std::uint32_t v, Position& position) {
    const std::span<const std::uint32_t> ring = surroundings_.ring(v);
    Lanes ring_sum(Quad{}), ring_size(Quad{});
    for (const std::uint32_t u : ring.first(std::min(ring.size(), kMostRing))) {
      ring_sum = ring_sum + Lanes(coded_[u].position);
      ring_size = ring_size + Lanes(coded_[u].size);
    }
    const WingSums wings = wings_of(v);
    const Guess guess = guess_at(wings, ring_sum.quad());
    const Quad sizes = ring_size.quad();
    const std::int64_t inverse = ring_sum[3] > 0 ? 65536 / ring_sum[3] : 0;
    Coded coded{{0, 0, 0, 1}, {}};
    std::int64_t others = 0;  // sizes of this vertex's residuals on the axes before, in 1/256
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t total = std::clamp(guess.sum[k], 0, guess.count() * last_index_);
      const std::int32_t predicted = divide(total, guess.count());
      const std::int64_t around = inverse > 0 ? (sizes[k] * inverse) >> 8 : running_[k];
      const std::int64_t same = k == 0 ? around : k == 1 ? others : others / 2;
      const std::int64_t expected = 5 * running_[k] + 6 * around + 5 * same;
      const ShapeChoice choice = choose(guess, total - predicted * guess.count(), around, expected);
      const std::int32_t residual =
          models_->code(coder, choice, Coder::kDecoding ? 0 : position[k] - predicted);
      const std::int32_t index = predicted + residual;
      if (index < 0 || index > last_index_) return false;
      if constexpr (Coder::kDecoding) position[k] = index;
      coded.position[k] = index;
      coded.size[k] = std::abs(residual);
      const std::int64_t size = std::int64_t{coded.size[k]} << 8;
      others += size;
      if (guess.wings > 0) running_[k] += (size - running_[k]) >> 5;
    }
    coded_[v] = coded;
    last_ = coded.position;
    if (guess.wings > 0) reach_.learn(wings, coded.position);
    for (const std::uint32_t u : ring) order_.raise(u);
    return true;
  }

  /// Rounded to the nearest, halves up.
  static std::int32_t divide(std::int32_t total, std::int32_t count) {
    const auto twice = 2 * static_cast<std::uint32_t>(total) + static_cast<std::uint32_t>(count);
    return static_cast<std::int32_t>(twice / (2 * static_cast<std::uint32_t>(count)));
  }

  WingSums wings_of(std::uint32_t v) const {
    const std::span<const ShapeSurroundings::Wing> wings = surroundings_.wings(v);
    Lanes ends(Quad{}), across(Quad{});
    for (const ShapeSurroundings::Wing& wing : wings.first(std::min(wings.size(), kMostWings))) {
      const Quad &a = coded_[wing.a].position, &b = coded_[wing.b].position, &o = coded_[wing.o].position;
      const Lanes all_coded = Lanes::all(-(a[3] & b[3] & o[3]));
      ends = ends + ((Lanes(a) + Lanes(b)) & all_coded);
      across = across + (Lanes(o) & all_coded);
    }
    return {ends.quad(), across.quad()};
  }

  /// The parallelograms that v closes, the mean of its neighbours, the vertex before, or the middle.
  Guess guess_at(const WingSums& wings, const Quad& ring_sum) const {
    if (wings.across[3] > 0) return {reach_.predict(wings), wings.across[3]};
    if (ring_sum[3] > 0) return {ring_sum, 0};
    if (last_[3] > 0) return {last_, 0};
    const std::int32_t middle = (last_index_ + 1) / 2;
    return {{middle, middle, middle, 1}, 0};
  }

  /// 3 log2 x, rounded down, for x from 1.
  static std::uint32_t thirds(std::uint32_t x) {
    const auto octave = static_cast<std::uint32_t>(std::bit_width(x)) - 1;
    const std::uint64_t rest = (std::uint64_t{x} << 8) >> octave;
    return 3 * octave + (rest >= 323 ? 1 : 0) + (rest >= 406 ? 1 : 0);
  }

  /// `rest` is what rounding the guess has lost, times its count; `around` is in 1/256, `expected` in
  /// 1/4096.
  static ShapeChoice choose(const Guess& guess, std::int32_t rest, std::int64_t around,
                            std::int64_t expected) {
    std::int64_t size = (guess.wings > 0 ? expected : 3 * expected) >> 4;
    int raw_bits = 0;
    for (; size > 640; size >>= 1) ++raw_bits;
    const std::uint32_t level = thirds(static_cast<std::uint32_t>(std::max<std::int64_t>(size, 5))) - 6;
    const std::int32_t eighths = 8 * std::abs(rest), count = guess.count();
    const auto near =
        static_cast<std::uint32_t>(std::min<std::int64_t>(around >> raw_bits, std::int64_t{1} << 30));
    return {level,
            eighths >= 3 * count ? 2u
            : eighths >= count   ? 1u
                                 : 0u,
            static_cast<std::uint32_t>(std::min(guess.wings, 3)),
            near < 77 ? 0 : std::min(15u, 1 + (thirds(near) - 18) / 2),
            raw_bits,
            rest < 0};
  }

  ShapeSurroundings surroundings_;
  ShapeOrder order_;
  std::int32_t last_index_;
  std::vector<Coded> coded_;  ///< [vertex]
  ShapeReach reach_;
  Quad last_{};                            ///< position of the vertex coded last
  std::array<std::int64_t, 3> running_{};  ///< mean size of residuals on each axis, in 1/256
  std::unique_ptr<ShapeModels> models_;
};

}  // namespace tvg
