#pragma once
#include "encoder/importers/scene_options.hpp"

#include <memory>
#include <string>
#include <vector>

#include <tvg/source.hpp>

namespace tvg::cli {

class SceneReader;

/// A scene as frames, with its skeleton, and what a user may want to know of it.
struct OpenedScene {
  std::unique_ptr<FrameSource> source;
  std::vector<std::string> notes;
};

/// Opens one clip of a scene and bakes it frame by frame as it is read: keys are interpolated (rotations
/// along the shortest arc), node transforms applied, skins blended linearly, morph targets added. A scene
/// without clips is one frame. An MD2 file holds a mesh per frame: all frames are read, each
/// as it is. Throws ToolError: kUsage (a clip, mesh or rate that is not there), kIo,
/// kInvalidInput.
OpenedScene open_scene(const std::string& path, const SceneOptions& options);

/// The same of a scene that has been opened already, and holds no mesh for each frame.
OpenedScene open_scene(const SceneReader& reader, const SceneOptions& options);

}  // namespace tvg::cli
