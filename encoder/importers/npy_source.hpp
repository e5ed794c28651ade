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

}  // namespace tvg::cli
