#pragma once
#include "attributes/edge_pairs.hpp"
#include "connectivity/vertex_order_coding.hpp"
#include "entropy/range_coder.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// The coding of which face is of which part (format-spec §5.8), written once for encoder and decoder.
namespace tvg {

class PartCoder {
 public:
  /// `partner` is what pair_edges() gives; there is a part at least.
  PartCoder(std::span<const std::uint32_t> partner, std::size_t part_count)
      : partner_(partner), part_count_(static_cast<std::uint32_t>(part_count)), used_(part_count) {
    use(0);
  }

  /// Codes the part of each face, in the order of the traversal: complete when encoding, filled in when
  /// decoding. False where the stream is malformed.
  template <class Coder>
  bool code(Coder& coder, std::span<std::uint32_t> parts) {
    for (std::uint32_t face = 0; face < parts.size(); ++face) {
      parts[face] = code_face(coder, parts, face);
      if (parts[face] >= part_count_) return false;
      use(parts[face]);
      if constexpr (Coder::kDecoding) {
        if (coder.overrun()) return false;
      }
    }
    return true;
  }

 private:
  /// Whether a face beside the one being coded is as expected.
  enum Beside : std::size_t { kNotYet, kAsExpected, kOther };

  template <class Coder>
  std::uint32_t code_face(Coder& coder, std::span<const std::uint32_t> parts, std::uint32_t face) {
    const std::uint32_t part = parts[face];
    const std::uint32_t gate = earlier_across(3 * face);
    std::uint32_t expected = 0;
    if (face > 0) expected = parts[gate == kNoCorner ? face - 1 : gate];
    std::array<std::uint32_t, 2> others{};
    std::array<Beside, 2> beside{};
    for (std::uint32_t side = 0; side < 2; ++side) {
      const std::uint32_t other = earlier_across(3 * face + 1 + side);
      if (other == kNoCorner) continue;
      others[side] = parts[other];
      beside[side] = others[side] == expected ? kAsExpected : kOther;
    }
    const std::size_t context = (gate == kNoCorner ? 0u : 9u) + 3 * beside[0] + beside[1];
    if (!coder.code(changes_[context], part != expected)) return expected;
    for (std::size_t side = 0; side < 2; ++side) {
      if (beside[side] != kOther || (side == 1 && beside[0] == kOther && others[0] == others[1])) continue;
      if (!coder.code(not_beside_[side], part != others[side])) return others[side];
    }
    if (lowest_unused_ < part_count_ && !coder.code(not_new_, part != lowest_unused_)) return lowest_unused_;
    return code_uniform(coder, part, part_count_);
  }

  /// The face across a half-edge, where it was coded before; else kNoCorner.
  std::uint32_t earlier_across(std::uint32_t half_edge) const {
    const std::uint32_t back = partner_[half_edge];
    return back != kNoCorner && back / 3 < half_edge / 3 ? back / 3 : kNoCorner;
  }

  void use(std::uint32_t part) {
    used_[part] = 1;
    while (lowest_unused_ < part_count_ && used_[lowest_unused_] != 0) ++lowest_unused_;
  }

  std::span<const std::uint32_t> partner_;
  std::uint32_t part_count_;
  std::vector<std::uint8_t> used_;  ///< [part]: whether a face has it; the first is taken for used
  std::uint32_t lowest_unused_ = 0;
  std::array<AdaptiveBit, 18> changes_;
  std::array<AdaptiveBit, 2> not_beside_;
  AdaptiveBit not_new_;
};

}  // namespace tvg
