#pragma once
#include <cstdint>
#include <vector>

#include <tvg/simplify.hpp>

namespace tvg::bench {

/// OpenMesh's decimater with its quadric module, on one frame ([vertex][xyz]), down to so many vertices.
/// Vertices without a face are left out; `places` are the nearest on the result in this frame.
SimplifiedMesh decimate_openmesh(const Mesh& mesh, const FramePositions& frame, std::uint32_t vertices);

/// The same by meshoptimizer's meshopt_simplify, whose number of indices is searched for so that it comes as
/// near as it gets from above.
SimplifiedMesh simplify_meshoptimizer(const Mesh& mesh, const FramePositions& frame, std::uint32_t vertices);

}  // namespace tvg::bench
