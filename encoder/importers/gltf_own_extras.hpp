#pragma once
#include "encoder/importers/gltf_model.hpp"
#include "encoder/importers/scene_reader.hpp"

namespace tvg::cli {

/// Takes from the `extras` of a primitive in a file that `tvg decode` wrote what glTF has no word for
/// (docs/formats.md): object and group, which polygons its triangles were, numbers of the part, names of
/// attributes. What does not fit, because another program changed the mesh, is passed over.
void read_own_extras(const tinygltf::Value& extras, ScenePart& part);

}  // namespace tvg::cli
