#pragma once
#include "connectivity/connectivity.hpp"
#include "entropy/code_bits.hpp"
#include "entropy/range_coder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
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
    for (std::uint64_t i = std::uint64_t{value} + 1; i <= size_; i += i & (~i + 1)) {
      --tree_[static_cast<std::size_t>(i)];
    }
  }

 private:
  std::vector<std::uint32_t> tree_;
  std::uint32_t size_;
};

/// Codes a value below `bound` (at least 1), all equally likely, in truncated binary.
template <class Coder>
std::uint32_t code_uniform(Coder& coder, std::uint32_t value, std::uint32_t bound) {
  const int bits = std::bit_width(bound | 1) - 1;
  const std::uint32_t short_codes = static_cast<std::uint32_t>((std::uint64_t{2} << bits) - bound);
  const std::uint32_t head = value < short_codes ? value : (value + short_codes) >> 1;
  const std::uint32_t decoded = code_bits(coder, head, bits);
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
    const int below = static_cast<int>(coded) - 1;
    return (1u << below) | code_bits(coder, value, below);
  }

 private:
  AdaptiveSymbol short_{16};
};

/// Mode kNear: each vertex index is coded by the number of unused indices between it and that of a reference.
class NearOrder {
 public:
  explicit NearOrder(std::span<const Gate> gates)
      : gates_(gates), count_(static_cast<std::uint32_t>(gates.size())), unused_(count_) {
    choices_.fill(AdaptiveSymbol(kReferences));
  }

  /// Codes a whole order: complete when encoding, filled in when decoding. False when the stream is
  /// malformed.
  template <class Coder>
  bool code(Coder& coder, std::span<std::uint32_t> order) {
    for (std::uint32_t i = 0; i < count_; ++i) {
      const Ranks ranks = reference_ranks(order, i);
      std::uint32_t rank = 0, choice = 0;
      if constexpr (!Coder::kDecoding) {
        rank = unused_.rank(order[i]);
        choice = cheapest(ranks, rank);
      }
      last_choice_ = coder.code(choices_[last_choice_], choice);
      if (last_choice_ >= kReferences) return false;
      const std::uint32_t reference = ranks[last_choice_];
      const bool below = coder.code(below_[last_choice_], rank < reference);
      const std::uint32_t distance = lengths_[last_choice_].code(coder, distance_of(rank, reference));
      if (distance >= (below ? reference : count_ - i - reference)) return false;
      order[i] = unused_.select(below ? reference - 1 - distance : reference + distance);
      unused_.remove(order[i]);
      if constexpr (Coder::kDecoding) {
        if (coder.overrun()) return false;
      }
    }
    return true;
  }

 private:
  static constexpr int kReferences = 5;
  using Ranks = std::array<std::uint32_t, kReferences>;

  /// Ranks, among the unused indices, of those of the last vertex, of n, p and o, and of where n + p - o
  /// points; 0 where there is no such vertex.
  Ranks reference_ranks(std::span<const std::uint32_t> order, std::uint32_t i) const {
    const Gate& gate = gates_[i];
    Ranks ranks{};
    if (i > 0) ranks[0] = unused_.rank(order[i - 1]);
    if (gate.n != kNoVertex) ranks[1] = unused_.rank(order[gate.n]);
    if (gate.p != kNoVertex) ranks[2] = unused_.rank(order[gate.p]);
    if (gate.o != kNoVertex) {
      ranks[3] = unused_.rank(order[gate.o]);
      const std::int64_t sum = std::int64_t{order[gate.n]} + order[gate.p] - order[gate.o];
      ranks[4] = unused_.rank(static_cast<std::uint32_t>(std::clamp<std::int64_t>(sum, 0, count_)));
    }
    return ranks;
  }

  static std::uint32_t distance_of(std::uint32_t rank, std::uint32_t reference) {
    return rank < reference ? reference - 1 - rank : rank - reference;
  }

  /// The encoder's choice: the fewest bits, where another reference than the last is worth two.
  std::uint32_t cheapest(const Ranks& ranks, std::uint32_t rank) const {
    std::uint32_t best = 0;
    int least = 64;
    for (std::uint32_t k = 0; k < kReferences; ++k) {
      const int cost = std::bit_width(distance_of(rank, ranks[k])) + (k == last_choice_ ? 0 : 2);
      if (cost < least) {
        least = cost;
        best = k;
      }
    }
    return best;
  }

  std::span<const Gate> gates_;
  std::uint32_t count_;
  IndexSet unused_;
  std::uint32_t last_choice_ = 0;
  std::array<AdaptiveSymbol, kReferences> choices_;  ///< [the vertex before's choice]
  std::array<AdaptiveBit, kReferences> below_;       ///< [choice]
  std::array<LengthModel, kReferences> lengths_;     ///< [choice]
};

/// Mode kUniform; otherwise like NearOrder::code.
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
