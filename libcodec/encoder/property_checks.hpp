#pragma once
#include <cstdint>
#include <span>

#include <tvg/encoder.hpp>
#include <tvg/properties.hpp>

namespace tvg {

/// Whether properties are those of this mesh and can be coded: kInvalidInput, or kInvalidArgument where bits
/// are out of range.
Status check_properties(const MeshProperties& properties, const Mesh& mesh, const AttributeBits& bits);

/// Whether the values of a frame, [attribute], are those of these properties, which were checked:
/// kInvalidInput or kInvalidArgument, with the frame's number. What is not animated is not looked at.
Status check_animated(const MeshProperties& properties, const Mesh& mesh,
                      std::span<const std::span<const float>> values, std::uint64_t frame);

/// The same properties, where no bits are left to the kind and animated attributes have no values.
MeshProperties with_settled_bits(MeshProperties properties, const AttributeBits& bits);

}  // namespace tvg
