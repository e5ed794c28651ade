#pragma once
#include "encoder/importers/scene_source.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace tvg::cli {

/// Frames of a file that holds one mesh per frame (MD2), by its first bytes; nothing for other files. Throws
/// ImportError: kIo; kInvalidInput for formats like it whose first frame is all that assimp gives (MD3, MDC,
/// MDL of Quake and 3D GameStudio), where they hold more than one.
std::optional<std::uint32_t> keyframe_count(const std::string& path);

/// Opens such a file. assimp gives one frame at a time, so that the file is read once for each; vertices are
/// welded that coincide in all frames, which takes a pass over them all. These files say no rate: `fps` of
/// the options is kept with the stream, and without it none.
OpenedScene open_keyframes(const std::string& path, std::uint32_t frames, const SceneOptions& options);

}  // namespace tvg::cli
