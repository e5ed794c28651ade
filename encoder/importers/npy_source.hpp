#pragma once
#include <memory>
#include <string>

#include <tvg/source.hpp>

namespace tvg::cli {

/// Opens a NumPy array (.npy) of shape [frame][vertex][xyz] or, for one frame, [vertex][xyz] as the frames of
/// a mesh: float16, float32 or float64 of either byte order, in C's order. Frames are read from disk one at a
/// time. `mesh_file` names the mesh in messages. Throws ImportError: kIo, kInvalidInput (another type, order
/// or shape, more bytes than promised), kTruncated (fewer).
std::unique_ptr<FrameSource> open_npy(const std::string& path, Mesh mesh, Metadata metadata,
                                      const std::string& mesh_file);

/// The same for an array of a .npz file, stored or deflated: that named `array`, or where that is empty the
/// one whose type and shape fit the mesh, of several the one with a usual name (vertices, verts, positions,
/// points).
std::unique_ptr<FrameSource> open_npz(const std::string& path, const Mesh& mesh, const Metadata& metadata,
                                      const std::string& mesh_file, const std::string& array);

}  // namespace tvg::cli
