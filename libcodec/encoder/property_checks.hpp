#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/encoder.hpp>
#include <tvg/properties.hpp>

namespace tvg {

/// Whether properties are those of this mesh and can be coded: kInvalidInput, or kInvalidArgument where bits
/// are out of range.
Status check_properties(const MeshProperties& properties, const Mesh& mesh, const AttributeBits& bits);

/// Whether properties that were checked take no more bytes than these, and no more of a frame:
/// kLimitExceeded.
Status check_property_bounds(const MeshProperties& properties, const Mesh& mesh, std::uint64_t property_bytes,
                             std::uint64_t frame_bytes);

/// Whether the values of a frame, [attribute], are those of these properties, which were checked:
/// kInvalidInput or kInvalidArgument, with the frame's number. What is not animated is not looked at.
Status check_animated(const MeshProperties& properties, const Mesh& mesh,
                      std::span<const std::span<const float>> values, std::uint64_t frame);

/// Of the values of a frame, which were checked, those of animated attributes.
std::vector<std::vector<float>> animated_of(const MeshProperties& properties,
                                            std::span<const std::span<const float>> values);

/// The same properties, where no bits are left to the kind and animated attributes have no values.
MeshProperties with_settled_bits(MeshProperties properties, const AttributeBits& bits);

}  // namespace tvg
