#include "encoder/importers/gltf_extensions.hpp"

#include "encoder/importers/import_error.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace tvg::cli {

namespace {

constexpr std::string_view kDraco = "KHR_draco_mesh_compression";

/// Read, or of no matter to positions; names that end in _ stand for all that begin so.
constexpr std::array<std::string_view, 19> kKnown = {"KHR_mesh_quantization",
                                                     "EXT_meshopt_compression",
                                                     "KHR_meshopt_compression",
                                                     "KHR_materials_",
                                                     "KHR_texture_",
                                                     "EXT_texture_",
                                                     "MSFT_texture_",
                                                     "MSFT_packing_",
                                                     "KHR_lights_",
                                                     "EXT_lights_",
                                                     "KHR_xmp_",
                                                     "KHR_techniques_webgl",
                                                     "KHR_technique_webgl",
                                                     "ADOBE_materials_",
                                                     "MSFT_lod",
                                                     "EXT_mesh_gpu_instancing",
                                                     "EXT_mesh_features",
                                                     "EXT_structural_metadata",
                                                     "KHR_xmp"};

/// What would place vertices, and what is done without it.
struct PassedOver {
  std::string_view name;
  const char* instead;
};
constexpr std::array<PassedOver, 2> kPassedOver = {
    {{"KHR_animation_pointer", "what only it moves stands still"},
     {"KHR_node_visibility", "hidden nodes are taken too"}}};

bool is_known(std::string_view name) {
  return std::any_of(kKnown.begin(), kKnown.end(), [name](std::string_view known) {
    return known.ends_with('_') ? name.starts_with(known) : name == known;
  });
}

}  // namespace

void check_required_extensions(const std::string& path, const std::vector<std::string>& required) {
  for (const std::string& name : required) {
    if (is_known(name)) continue;
    throw ImportError(
        ErrorCode::kInvalidInput,
        fmt::format("{}: it requires the extension {}, which is not read: export it without{}", path, name,
                    name == kDraco ? " Draco's compression, or with meshoptimizer's (gltfpack -c)" : ""));
  }
}

std::vector<std::string> extension_notes(const std::string& path, const std::vector<std::string>& used) {
  std::vector<std::string> notes;
  for (const PassedOver& extension : kPassedOver) {
    if (std::find(used.begin(), used.end(), extension.name) == used.end()) continue;
    notes.push_back(
        fmt::format("{}: the extension {} is passed over: {}", path, extension.name, extension.instead));
  }
  return notes;
}

}  // namespace tvg::cli
