#pragma once
#include "attributes/animated_attributes.hpp"
#include "connectivity/mesh_coder.hpp"
#include "container/mesh_payload.hpp"
#include "planes/reference_shape.hpp"

#include <span>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// Decodes what a mesh has beside its connectivity from the sections of its chunk (format-spec §5.7 to §5.9),
/// in terms of `coded.mesh`, whose faces it puts in the order of polygons where there are any. `faces` are
/// its faces in traversal indices; `shape` is null where it has none. `limits` are the stream's. `animated`
/// is what frames need to know of animated attributes. kMalformed, kLimitExceeded, kOutOfMemory.
Result<MeshProperties> decode_properties(const MeshLayout& layout, CodedMesh& coded,
                                         std::span<const Face> faces, const ReferenceShape* shape,
                                         const StreamLimits& limits, AnimatedAttributes& animated);

}  // namespace tvg
