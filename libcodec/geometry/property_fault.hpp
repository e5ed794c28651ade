#pragma once
#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// One sentence on why `properties` are not those of a mesh like this, or why a face has a vertex that the
/// mesh does not have; null where they fit. The values of animated attributes are not looked at, for they
/// come with frames.
const char* property_fault(const Mesh& mesh, const MeshProperties& properties);

}  // namespace tvg
