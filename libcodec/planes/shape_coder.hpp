#pragma once
#include "planes/lanes.hpp"
#include "planes/shape_models.hpp"
#include "planes/shape_order.hpp"
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
  using Position = std::array<std::int32_t, 3>;

  static constexpr std::size_t kBytesPerVertex =
      ShapeSurroundings::kBytesPerVertex + ShapeOrder::kBytesPerVertex + 2 * sizeof(Quad);
  static constexpr std::size_t kBytesPerFace = ShapeSurroundings::kBytesPerFace;
  static constexpr std::size_t kModelBytes = sizeof(ShapeModels);

  ShapeCoder(std::span<const Face> faces, std::uint32_t vertex_count, int bits)
      : surroundings_(faces, vertex_count),
        order_(vertex_count),
        last_index_((std::int32_t{1} << bits) - 1),
        known_(vertex_count, Quad{}),
        sizes_(vertex_count, Quad{}),
        models_(std::make_unique<ShapeModels>()) {
    running_.fill(std::int64_t{8} << 8);
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
  static constexpr std::size_t kMostRing = 64, kMostWings = 32;

  /// A sum of positions, to be divided by their number.
  struct Guess {
    Quad sum;
    std::int32_t count, wings;
  };

  template <class Coder>
  bool code_vertex(Coder& coder, std::uint32_t v, Position& position) {
    const std::span<const std::uint32_t> whole = surroundings_.ring(v);
    const auto ring = whole.first(std::min(whole.size(), kMostRing));
    Lanes sum(Quad{}), sizes(Quad{});
    for (const std::uint32_t u : ring) {
      sum = sum + Lanes(known_[u]);
      sizes = sizes + Lanes(sizes_[u]);
    }
    const Guess guess = guess_at(v, sum.quad());
    const std::int32_t near = sum[3];
    std::int64_t others = 0;
    Quad coded{0, 0, 0, 1}, size{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t total = std::clamp(guess.sum[k], 0, guess.count * last_index_);
      const std::int32_t predicted = (2 * total + guess.count) / (2 * guess.count);
      const std::int32_t rest = total - predicted * guess.count;
      const std::int64_t around = near > 0 ? (std::int64_t{sizes[k]} << 8) / near : running_[k];
      const ShapeChoice choice = choose(k, guess, rest, around, others);
      const std::int32_t residual =
          models_->code(coder, choice, Coder::kDecoding ? 0 : position[k] - predicted);
      const std::int32_t index = predicted + residual;
      if (index < 0 || index > last_index_) return false;
      if constexpr (Coder::kDecoding) position[k] = index;
      coded[k] = index;
      size[k] = std::abs(residual);
      others += std::int64_t{size[k]} << 8;
      if (guess.wings > 0) running_[k] += ((std::int64_t{size[k]} << 8) - running_[k]) / 64;
    }
    known_[v] = coded;
    sizes_[v] = size;
    last_ = coded;
    for (const std::uint32_t u : whole) order_.raise(u);
    return true;
  }

  /// The mean of the parallelograms that v closes, of its neighbours, the vertex before, or the middle.
  Guess guess_at(std::uint32_t v, const Quad& ring_sum) const {
    const std::span<const ShapeSurroundings::Wing> all = surroundings_.wings(v);
    Lanes sum(Quad{});
    for (const ShapeSurroundings::Wing& wing : all.first(std::min(all.size(), kMostWings))) {
      const Lanes a(known_[wing.a]), b(known_[wing.b]), o(known_[wing.o]);
      const std::int32_t whole = a[3] & b[3] & o[3];
      sum = sum + ((a + b - o) & Lanes::all(-whole));
    }
    if (sum[3] > 0) return {sum.quad(), sum[3], sum[3]};
    if (ring_sum[3] > 0) return {ring_sum, ring_sum[3], 0};
    if (last_[3] > 0) return {last_, 1, 0};
    const std::int32_t middle = (last_index_ + 1) / 2;
    return {{middle, middle, middle, 1}, 1, 0};
  }

  /// 3 log2 x, rounded down, for x from 1.
  static std::uint32_t thirds(std::uint32_t x) {
    const auto octave = static_cast<std::uint32_t>(std::bit_width(x)) - 1;
    const std::uint64_t rest = (std::uint64_t{x} << 8) >> octave;
    return 3 * octave + (rest >= 323 ? 1 : 0) + (rest >= 406 ? 1 : 0);
  }
  /// 0 to 15.
  static std::uint32_t coarse(std::int64_t size) {
    const auto x = static_cast<std::uint32_t>(std::min<std::int64_t>(size, 1 << 30));
    return x < 77 ? 0 : std::min(15u, 1 + (thirds(x) - 18) / 2);
  }

  ShapeChoice choose(std::size_t k, const Guess& guess, std::int32_t rest, std::int64_t around,
                     std::int64_t others) const {
    const auto axis = static_cast<std::uint32_t>(k);
    std::int64_t expected = 51 * running_[k] + 128 * around +
                            77 * (k == 0   ? around
                                  : k == 1 ? others
                                           : others / 2);
    expected = (guess.wings > 0 ? expected : 3 * expected) >> 8;
    int raw_bits = 0;
    while (expected > 1536 && raw_bits < 20) expected >>= 1, ++raw_bits;
    const std::uint32_t least = 5;
    const std::uint32_t level =
        std::min(28u, thirds(static_cast<std::uint32_t>(std::max<std::int64_t>(expected, least))) - 6);
    const std::uint32_t lost = static_cast<std::uint32_t>(std::abs(rest) * 8 / guess.count);
    const std::uint32_t kind = static_cast<std::uint32_t>(std::min(guess.wings, 3));
    const std::uint32_t lost3 = lost >= 3 ? 2 : lost >= 1 ? 1 : 0;
    return {{level * 3 + lost3 + (raw_bits > 0 ? 90 : 0), kind * 16 + coarse(around >> raw_bits),
             coarse(others >> raw_bits) * 3 + axis, kind * 3 + axis,
             (level / 3) * 4 + std::min(lost, 3u) + 40 * kind},
            level,
            raw_bits,
            rest < 0};
  }

  ShapeSurroundings surroundings_;
  ShapeOrder order_;
  std::int32_t last_index_;
  std::vector<Quad> known_;  ///< [vertex]: x, y, z, 1 where coded, else all 0
  std::vector<Quad> sizes_;  ///< [vertex]: sizes of residuals where coded, else all 0
  Quad last_{};
  std::array<std::int64_t, 3> running_{};
  std::unique_ptr<ShapeModels> models_;
};

}  // namespace tvg
