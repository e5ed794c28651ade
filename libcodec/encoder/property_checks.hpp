#pragma once
#include <tvg/encoder.hpp>
#include <tvg/properties.hpp>

namespace tvg {

/// Whether properties are those of this mesh and can be coded: kInvalidInput, or kInvalidArgument where bits
/// are out of range.
Status check_properties(const MeshProperties& properties, const Mesh& mesh, const AttributeBits& bits);

/// The same properties, where no bits are left to the kind.
MeshProperties with_settled_bits(MeshProperties properties, const AttributeBits& bits);

}  // namespace tvg
