#pragma once
#include <cstdint>
#include <optional>

#include <tvg/geometry.hpp>
#include <tvg/source.hpp>

namespace tvg {

/// What reading all of a source tells.
struct SourceFacts {
  BoundingBox box;                   ///< of all frames
  std::uint32_t vertices = 0;        ///< of the mesh that has most
  std::uint32_t faces = 0;           ///< of the mesh that has most
  std::uint64_t property_bytes = 0;  ///< of the mesh that has most beside its connectivity (format-spec §5.7)
  std::uint64_t animated_frame_bytes = 0;  ///< that animated attributes of any mesh may take of a frame
  std::uint64_t frames = 0;
  std::uint64_t stretches = 0;  ///< runs of frames of one mesh
  /// How many of the latest meshes are worth keeping, 1 to kMostMeshesKept: more make fewer to be sent again.
  std::uint32_t meshes = 1;
  bool mesh_returns = false;  ///< a mesh comes again after another one

  /// Each frame has a mesh of its own, or nearly so, as in captured volumes.
  bool captured() const { return stretches > 1 && !mesh_returns && frames < 2 * stretches; }
};

constexpr std::uint32_t kMostMeshesKept = 16;

/// Reads a source from its beginning to its end and leaves it at its first frame. Nothing where it can be
/// read only once. Fails as read_checked() does, and with kInvalidInput where there are no frames.
Result<std::optional<SourceFacts>> look_through(FrameSource& source);

}  // namespace tvg
