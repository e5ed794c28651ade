#pragma once
#include "attributes/animated_attributes.hpp"
#include "attributes/property_mesh.hpp"
#include "attributes/property_size.hpp"
#include "base/byte_io.hpp"

#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// Decodes the attributes of a mesh from all of its section (format-spec §5.7): values of vertices in the
/// order frames are given in, corners by the faces as `mesh` has them. `part_count` is how many parts there
/// are. The values of those that are animated, which are then in `animated` too, are 0. Nothing is allocated
/// that `budget` does not allow, beside what the figure of decoder memory has for it. kMalformed,
/// kLimitExceeded, kOutOfMemory.
Result<std::vector<Attribute>> decode_attributes(Bytes section, const PropertyMesh& mesh,
                                                 std::size_t part_count, PropertyBudget& budget,
                                                 AnimatedAttributes& animated);

/// Reads where the numbers of an attribute lie, where its grid has steps (format-spec §5.7, §5.7.7).
Fault read_steps(ByteReader& reader, AttributeGrid& grid);

}  // namespace tvg
