#pragma once
#include "encoder/importers/scene_reader.hpp"

#include <string>
#include <vector>

namespace tvg::cli {

/// The number of the clip that `wanted` names: by its name, or by its number where no clip has that name.
/// Throws ToolError (kUsage) that lists the clips where there is no such, or more than one of that name.
std::size_t find_clip(const Scene& scene, const std::string& wanted);

/// Which instances `wanted` names, [instance]: by the name of a mesh or of a node that holds it, or by the
/// number of a mesh where nothing has that name; all where it is empty. Notes where several things have one
/// name. Throws ToolError (kUsage) where a name is not there.
std::vector<char> choose_instances(const Scene& scene, const std::vector<std::string>& wanted,
                                   std::vector<std::string>& notes);

}  // namespace tvg::cli
