#pragma once
#include "connectivity/connectivity.hpp"
#include "entropy/range_coder.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

// The coding of the vertex order (format-spec §5.2), written once for encoder and decoder.
namespace tvg {

/// How an order is coded: the first byte of its stream.
enum class OrderMode : std::uint8_t {
  kIdentity = 0,  ///< traversal and vertex indices are the same; nothing follows
  kNear = 1,      ///< each index by its distance from that of a vertex nearby
  kUniform = 2,   ///< each index by its rank among those left
};

/// A set of the integers 0 to n - 1 that starts full, with ranks (a Fenwick tree).
class IndexSet {
 public:
  explicit IndexSet(std::uint32_t size) : tree_(std::size_t{size} + 1), size_(size) {
    for (std::uint32_t i = 1; i <= size; ++i) tree_[i] = i & (~i + 1);
  }

  /// Number of members below `value`.
  std::uint32_t rank(std::uint32_t value) const {
    std::uint32_t sum = 0;
    for (std::uint32_t i = value; i > 0; i &= i - 1) sum += tree_[i];
    return sum;
  }

  /// The member of rank `rank`, which is below the number of members.
  std::uint32_t select(std::uint32_t rank) const {
    std::uint32_t position = 0;
    for (std::uint32_t step = std::bit_floor(size_); step > 0; step /= 2) {
      if (position + step <= size_ && tree_[position + step] <= rank) {
        position += step;
        rank -= tree_[position];
      }
    }
    return position;
  }

  void remove(std::uint32_t value) {
    for (std::uint64_t i = std::uint64_t{value} + 1; i <= size_; i += i & (~i + 1)) --tree_[i];
  }

 private:
  std::vector<std::uint32_t> tree_;
  std::uint32_t size_;
};

/// Codes a value below `bound` (at least 1), all equally likely, in truncated binary.
template <class Coder>
std::uint32_t code_uniform(Coder& coder, std::uint32_t value, std::uint32_t bound) {
  const int bits = std::bit_width(bound) - 1;
  const std::uint32_t short_codes = static_cast<std::uint32_t>((std::uint64_t{2} << bits) - bound);
  std::uint32_t head = value < short_codes ? value : (value + short_codes) >> 1;
  std::uint32_t decoded = 0;
  for (int left = bits; left > 0;) {
    const int count = left < 15 ? left : 15;
    left -= count;
    decoded = (decoded << count) | coder.code_raw((head >> left) & ((1u << count) - 1), count);
  }
  if (decoded < short_codes) return decoded;
  return decoded * 2 + coder.code_raw((value + short_codes) & 1, 1) - short_codes;
}

/// Codes numbers by their length in bits, adaptively, and then the bits.
class LengthModel {
 public:
  template <class Coder>
  std::uint32_t code(Coder& coder, std::uint32_t value) {
    const auto length = static_cast<std::uint32_t>(std::bit_width(value));
    std::uint32_t coded = coder.code(short_, length < 15 ? length : 15);
    if (coded == 15) coded += coder.code_raw(length - 15, 5);
    if (coded <= 1) return coded;
    if (coded > 32) return 0xFFFFFFFF;
    std::uint32_t result = 1;
    for (int left = static_cast<int>(coded) - 1; left > 0;) {
      const int count = left < 15 ? left : 15;
      left -= count;
      result = (result << count) | coder.code_raw((value >> left) & ((1u << count) - 1), count);
    }
    return result;
  }

 private:
  AdaptiveSymbol short_{16};
};

/// Codes an order in mode kNear. `order` is complete when encoding, and filled in when decoding. False when
/// the stream is malformed.
template <class Coder>
bool code_near_order(Coder& coder, std::span<std::uint32_t> order, std::span<const Gate> gates) {
  const auto count = static_cast<std::uint32_t>(gates.size());
  IndexSet unused(count);
  AdaptiveSymbol first_choice(4);
  std::array<AdaptiveSymbol, 4> choices;
  choices.fill(first_choice);
  std::array<AdaptiveBit, 4> signs;
  std::array<LengthModel, 4> lengths;
  std::uint32_t choice = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::array<std::uint32_t, 4> near = {i > 0 ? i - 1 : kNoVertex, gates[i].n, gates[i].p, gates[i].o};
    std::array<std::uint32_t, 4> ranks{};
    for (std::size_t k = 0; k < 4; ++k) ranks[k] = near[k] == kNoVertex ? 0 : unused.rank(order[near[k]]);
    std::uint32_t rank = 0;
    std::uint32_t best = 0;
    if constexpr (!Coder::kDecoding) {
      rank = unused.rank(order[i]);
      std::uint32_t least = 0xFFFFFFFF;
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t distance = rank >= ranks[k] ? rank - ranks[k] : ranks[k] - 1 - rank;
        if (distance < least) {
          least = distance;
          best = k;
        }
      }
    }
    choice = coder.code(choices[choice], best);
    if (choice >= 4) return false;
    const std::uint32_t reference = ranks[choice];
    const bool below = coder.code(signs[choice], rank < reference);
    const std::uint32_t distance =
        lengths[choice].code(coder, below ? reference - 1 - rank : rank - reference);
    if (below ? distance >= reference : distance >= count - i - reference) return false;
    rank = below ? reference - 1 - distance : reference + distance;
    const std::uint32_t index = unused.select(rank);
    order[i] = index;
    unused.remove(index);
    if constexpr (Coder::kDecoding) {
      if (coder.overrun()) return false;
    }
  }
  return true;
}

/// Codes an order in mode kUniform, otherwise like code_near_order.
template <class Coder>
bool code_uniform_order(Coder& coder, std::span<std::uint32_t> order) {
  const auto count = static_cast<std::uint32_t>(order.size());
  IndexSet unused(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t rank = code_uniform(coder, Coder::kDecoding ? 0 : unused.rank(order[i]), count - i);
    order[i] = unused.select(rank);
    unused.remove(order[i]);
    if constexpr (Coder::kDecoding) {
      if (coder.overrun()) return false;
    }
  }
  return true;
}

}  // namespace tvg
