#pragma once
#include <nlohmann/json.hpp>

namespace tvg::cli {

/// Makes a material valid glTF, whoever described it: factors lie from 0 to 1, with
/// KHR_materials_emissive_strength where light is stronger than that, and what has another type than glTF
/// gives it is left out, so that its default holds.
void repair_gltf_material(nlohmann::json& material);

}  // namespace tvg::cli
