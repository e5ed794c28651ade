#pragma once
#include "encoder/importers/gltf_clip.hpp"
#include "encoder/importers/gltf_document.hpp"
#include "encoder/importers/scene_reader.hpp"

namespace tvg::cli {

/// Puts the nodes of a glTF file into `scene`, parents first: those of its scene, whose meshes become
/// instances, then those of none, which may be joints. Throws ImportError (kInvalidInput): numbers that are
/// not there, a node with two parents or below itself.
void read_gltf_nodes(const GltfDocument& document, Scene& scene, GltfNodes& nodes);

}  // namespace tvg::cli
