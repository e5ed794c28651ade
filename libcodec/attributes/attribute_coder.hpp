#pragma once
#include "attributes/attribute_grid.hpp"
#include "attributes/edge_pairs.hpp"
#include "attributes/property_mesh.hpp"
#include "attributes/wedges.hpp"
#include "connectivity/vertex_order_coding.hpp"
#include "entropy/range_coder.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// The coding of seams and values of attributes (format-spec §5.7), written once for encoder and decoder.
namespace tvg {

class AttributeCoder {
 public:
  explicit AttributeCoder(const PropertyMesh& mesh) : mesh_(mesh) {}

  /// The seams of an attribute of corners: [half-edge], not 0 for both half-edges of a seam.
  template <class Coder>
  bool code_seams(Coder& coder, std::span<std::uint8_t> seams) {
    const std::span<const std::uint32_t> partner = partners();
    AdaptiveBit model;
    for (std::uint32_t h = 0; h < seams.size(); ++h) {
      const std::uint32_t back = partner[h];
      if (back == kNoCorner || back > h) continue;
      seams[h] = seams[back] = coder.code(model, seams[h] != 0) ? 1 : 0;
      if (!is_whole(coder)) return false;
    }
    return true;
  }

  /// [half-edge]: as pair_edges() has it.
  std::span<const std::uint32_t> partners() {
    if (partners_.empty()) partners_ = pair_edges(mesh_.faces, mesh_.vertex_count());
    return partners_;
  }

  /// The integers of `count` values, [value][integer]. False where the stream is malformed.
  template <class Coder>
  bool code_values(Coder& coder, const AttributeGrid& grid, std::span<std::int32_t> values) {
    const std::size_t width = grid.integers();
    std::array<LengthModel, kMaxAttributeComponents> sizes;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::uint32_t before = i < width ? 0 : static_cast<std::uint32_t>(values[i - width]);
      const std::uint32_t difference = static_cast<std::uint32_t>(values[i]) - before;
      const std::uint32_t folded = difference << 1 ^ (difference >> 31 == 0 ? 0 : 0xFFFFFFFFu);
      const std::uint32_t coded = sizes[i % width].code(coder, folded);
      values[i] = static_cast<std::int32_t>(before + (coded >> 1 ^ ((coded & 1) == 0 ? 0 : 0xFFFFFFFFu)));
      if (!is_whole(coder)) return false;
    }
    return true;
  }

 private:
  template <class Coder>
  static bool is_whole(const Coder& coder) {
    if constexpr (Coder::kDecoding) return !coder.overrun();
    return true;
  }

  const PropertyMesh& mesh_;
  std::vector<std::uint32_t> partners_;
};

}  // namespace tvg
