#pragma once
#include "attributes/property_mesh.hpp"
#include "attributes/property_size.hpp"
#include "base/byte_io.hpp"

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// Decodes the parts of a mesh, and which of them each face is of, from all of their section (format-spec
/// §5.8) into `properties`; faces are counted as `mesh` has them. kMalformed, kLimitExceeded, kOutOfMemory.
Status decode_parts(Bytes section, const PropertyMesh& mesh, PropertyBudget& budget,
                    MeshProperties& properties);

}  // namespace tvg
