#pragma once
#include "encoder/importers/scene_clip.hpp"
#include "encoder/importers/scene_skeleton.hpp"

#include <string>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// What NamedData calls "skeleton" and "skeleton/positions": the joints in the frames of `range`, of a clip
/// that is sampled at `fps`. Positions that are more than data may be are left out with a note.
std::vector<NamedData> skeleton_data(const SceneSkeleton& skeleton, const SceneNodes& nodes, const Clip& clip,
                                     double fps, const FrameRange& range, std::vector<std::string>& notes);

}  // namespace tvg::cli
