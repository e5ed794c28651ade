#pragma once
#include "attributes/animated_attributes.hpp"
#include "connectivity/mesh_coder_encode.hpp"
#include "planes/reference_shape.hpp"

#include <tvg/properties.hpp>

namespace tvg {

/// Writes the sections of a mesh that decode_properties() reads into `mesh`. The properties are those of the
/// mesh that was encoded, and bits are settled; `shape` is null where the mesh has none.
/// `animated` becomes what frames need to know of animated attributes.
void encode_properties(const MeshProperties& properties, const ReferenceShape* shape, EncodedMesh& mesh,
                       AnimatedAttributes& animated);

}  // namespace tvg
