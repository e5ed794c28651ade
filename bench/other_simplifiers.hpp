#pragma once
#include <cstdint>
#include <vector>

#include <tvg/simplify.hpp>

namespace tvg::bench {

/// OpenMesh's decimater with its quadric module, on one frame ([vertex][xyz]), down to so many vertices: the
/// faces that are left, by the vertices of `mesh`.
std::vector<Face> decimate_openmesh(const Mesh& mesh, const FramePositions& frame, std::uint32_t vertices);

/// The same by meshoptimizer's meshopt_simplify, whose number of indices is searched for so that it comes as
/// near as it gets from above.
std::vector<Face> simplify_meshoptimizer(const Mesh& mesh, const FramePositions& frame,
                                         std::uint32_t vertices);

/// A mesh of what is left; vertices without a face are left out, and `places` are the nearest in the frame.
SimplifiedMesh mesh_of(std::vector<Face> faces, const FramePositions& frame);

}  // namespace tvg::bench
