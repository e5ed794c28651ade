#pragma once
#include "encoder/importers/gltf_accessors.hpp"
#include "encoder/importers/scene_reader.hpp"

#include <string>

namespace tvg::cli {

/// Adds the attributes of a primitive to a part that has its positions: texture coordinates with v turned
/// over, normals, colours from 0 to 1, and those of an application (_NAME) as they are. `name` is the
/// primitive's, for messages. One that cannot be read is left out with a note, for what matters most is
/// there.
void read_gltf_attributes(const tinygltf::Primitive& primitive, const std::string& name,
                          GltfAccessors& accessors, ScenePart& part);

}  // namespace tvg::cli
