#pragma once
#include "attributes/property_mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include <tvg/properties.hpp>

namespace tvg {

/// Writes what decode_attributes() reads. The attributes fit the mesh, and their bits are settled;
/// `first_corners` are those of the mesh's faces in the order of the attributes' corners
/// (EncodedConnectivity). Empty where there are no attributes.
std::vector<std::uint8_t> encode_attributes(std::span<const Attribute> attributes, const PropertyMesh& mesh,
                                            std::span<const std::uint32_t> first_corners);

}  // namespace tvg
