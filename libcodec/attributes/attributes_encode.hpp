#pragma once
#include "attributes/animated_attributes.hpp"
#include "attributes/property_mesh.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/properties.hpp>

namespace tvg {

/// Writes what decode_attributes() reads. The attributes fit the mesh, and their bits are settled;
/// `first_corners` are those of the mesh's faces in the order of the attributes' corners
/// (EncodedConnectivity). `part_count` is how many parts there are. What frames need to know of animated
/// attributes, whose values are not looked at, is put into `animated`. Empty where there are no attributes.
std::vector<std::uint8_t> encode_attributes(std::span<const Attribute> attributes, const PropertyMesh& mesh,
                                            std::span<const std::uint32_t> first_corners,
                                            std::size_t part_count, AnimatedAttributes& animated);

}  // namespace tvg
