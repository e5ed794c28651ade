#pragma once
#include "attributes/property_mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include <tvg/properties.hpp>

namespace tvg {

/// Writes what decode_parts() reads. `first_corners` are those of the mesh's faces in the order of the
/// properties' (EncodedConnectivity). Empty where there are no parts.
std::vector<std::uint8_t> encode_parts(const MeshProperties& properties, const PropertyMesh& mesh,
                                       std::span<const std::uint32_t> first_corners);

}  // namespace tvg
