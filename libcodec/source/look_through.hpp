#pragma once
#include <cstdint>
#include <optional>

#include <tvg/parts.hpp>
#include <tvg/source.hpp>

namespace tvg {

constexpr std::uint32_t kMostMeshesKept = 16;

/// What tells the mesh that a source has now, with what that has beside faces, from others.
std::uint64_t mesh_hash(const FrameSource& source);

/// Reads a source from its beginning to its end and leaves it at its first frame. Of stretches what shaped
/// their meshes is left to the caller; `meshes` are the latest that are worth keeping, 1 to kMostMeshesKept:
/// more make fewer to be sent again. `progress` is told of frames read. Nothing where it can be read only
/// once. Fails as read_checked() does, and with kInvalidInput where there are no frames.
Result<std::optional<EncodePlan>> look_through(FrameSource& source, const EncodeProgress& progress = {});

}  // namespace tvg
