#pragma once
#include <cstdint>
#include <span>

#include <tvg/source.hpp>

// What callers give to be encoded or measured is checked before anything looks at it.
namespace tvg {

/// kInvalidInput unless the mesh has vertices, no more of anything than a stream can hold, and faces that
/// refer to its vertices.
Status check_mesh(const Mesh& mesh);

/// kInvalidInput, with `number` as the frame's, for coordinates that are infinite or not a number.
Status check_frame(std::span<const float> frame, std::uint64_t number);

/// Reads the next frame ([vertex][xyz]) into `frame`, which has its size. False at the end. Fails as the
/// source does and as check_frame().
Result<bool> read_checked(FrameSource& source, FramePositions& frame, std::uint64_t number);

/// kInvalidInput, with `number` as the frame's, unless every joint of the skeleton is somewhere
/// ([joint][xyz]).
Status check_joints(std::span<const float> joints, const Skeleton& skeleton, std::uint64_t number);

}  // namespace tvg
