#pragma once
#include "attributes/attribute_grid.hpp"
#include "attributes/edge_pairs.hpp"
#include "attributes/field_coder.hpp"
#include "attributes/normal_coder.hpp"
#include "attributes/property_mesh.hpp"
#include "attributes/seam_coder.hpp"
#include "attributes/wedges.hpp"
#include "connectivity/vertex_order_coding.hpp"
#include "entropy/range_coder.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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
    if (!seam_coder_) seam_coder_.emplace(mesh_, partners());
    return seam_coder_->code(coder, seams);
  }

  /// [half-edge]: as pair_edges() has it.
  std::span<const std::uint32_t> partners() {
    if (partners_.empty()) partners_ = pair_edges(mesh_.faces, mesh_.vertex_count());
    return partners_;
  }

  /// The integers of `count` values, [value][integer]. False where the stream is malformed.
  template <class Coder>
  bool code_values(Coder& coder, const AttributeGrid& grid, std::span<const std::uint32_t> of_corner, std::span<std::int32_t> values) {
    if (grid.octahedral()) {
      const WedgeFans fans(of_corner, values.size() / grid.integers());
      return NormalCoder(mesh_, fans, grid).code(coder, values);
    }
    if (grid.stepped()) {
      const WedgeFans fans(of_corner, values.size() / grid.integers());
      return FieldCoder(mesh_, fans, partners(), grid).code(coder, values);
    }
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
  std::optional<SeamCoder> seam_coder_;
};

}  // namespace tvg
