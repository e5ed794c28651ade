#pragma once
#include <cstdint>
#include <vector>

#include <tvg/source.hpp>

// What callers give to be encoded or measured is checked before anything looks at it.
namespace tvg {

/// kInvalidInput unless the mesh has vertices, no more of anything than a stream can hold, and faces that
/// refer to its vertices.
Status check_mesh(const Mesh& mesh);

/// Reads the next frame ([vertex][xyz]) into `frame`, which has its size. False at the end. kInvalidInput,
/// with `number` as the frame's, for coordinates that are infinite or not a number.
Result<bool> read_checked(FrameSource& source, FramePositions& frame, std::uint64_t number);

/// Where the joints are in the frame that was read last ([joint][xyz]). kInvalidInput unless all of them are
/// somewhere.
Result<std::vector<float>> read_joints(const FrameSource& source, std::uint64_t number);

}  // namespace tvg
