#pragma once

namespace tvg::cli {

/// A source of frames whose mesh may be another one from some frame on.
class MeshChanges {
 public:
  virtual ~MeshChanges() = default;

  /// After read_frame() gave an error: whether it says no more than that the mesh is another one from this
  /// frame on. Then the source goes on with that mesh, which mesh() is now, and the frame is read next.
  /// Throws ToolError where the new mesh cannot be read.
  virtual bool go_on_with_next_mesh() = 0;
};

}  // namespace tvg::cli
