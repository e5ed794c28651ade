#pragma once
#include "attributes/field_coder.hpp"
#include "attributes/normal_coder.hpp"
#include "attributes/seam_coder.hpp"
#include "attributes/wedges.hpp"
#include "entropy/range_coder.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// The coding of seams and values of attributes (format-spec §5.7), written once for encoder and decoder.
namespace tvg {

class AttributeCoder {
 public:
  explicit AttributeCoder(const PropertyMesh& mesh)
      : mesh_(mesh), partner_(pair_edges(mesh.faces, mesh.vertex_count())), seams_(mesh, partner_) {}

  /// What it takes beside what it is given, for one attribute after the other, in bytes.
  static std::uint64_t bytes(const PropertyMesh& mesh, std::size_t part_count) {
    constexpr std::uint64_t kPerValue =
        std::max(FieldCoder::kBytesPerValue, NormalCoder::kBytesPerValue) + 4 + 4 * kMaxAttributeComponents;
    const std::uint64_t faces = mesh.faces.size(), vertices = mesh.vertex_count();
    const std::uint64_t values = std::max({3 * faces, vertices, std::uint64_t{part_count}});
    return kPerValue * values + 72 * faces + 24 * vertices + 64;
  }

  /// [half-edge]: as pair_edges() has it.
  std::span<const std::uint32_t> partner() const { return partner_; }

  /// The seams of an attribute of corners: [half-edge], not 0 for both half-edges of a seam.
  template <class Coder>
  bool code_seams(Coder& coder, std::span<std::uint8_t> seams) {
    return seams_.code(coder, seams);
  }

  /// The integers of values, [value][integer], which `of_corner` says the corners of: empty where they have
  /// none. False where the stream is malformed.
  template <class Coder>
  bool code_values(Coder& coder, const AttributeGrid& grid, std::span<const std::uint32_t> of_corner,
                   std::span<std::int32_t> integers) {
    const WedgeFans fans(of_corner, integers.size() / grid.integers());
    if (grid.octahedral()) {
      NormalModels models;
      return NormalCoder(mesh_, fans, grid, models).code(coder, integers);
    }
    FieldModels models(grid);
    return FieldCoder(mesh_, fans, partner_, grid, models).code(coder, integers);
  }

 private:
  const PropertyMesh& mesh_;
  std::vector<std::uint32_t> partner_;
  SeamCoder seams_;
};

}  // namespace tvg
