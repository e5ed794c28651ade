#include "cli/scene_info.hpp"

#include "encoder/importers/scene_file.hpp"
#include "encoder/importers/scene_summary.hpp"
#include "tool/mesh_format.hpp"
#include "tool/option_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace tvg::cli {

namespace {

void print_json(const std::string& path, const std::string& fps, const SceneSummary& scene) {
  nlohmann::json json = {{"file", path},
                         {"fps", fps},
                         {"metadata", scene.metadata},
                         {"clips", nlohmann::json::array()},
                         {"meshes", nlohmann::json::array()},
                         {"joints", nlohmann::json::array()},
                         {"welded_vertices", scene.welded_vertices},
                         {"notes", scene.notes}};
  if (scene.keyframes) json["keyframes"] = *scene.keyframes;
  for (const auto& clip : scene.clips) {
    json["clips"].push_back({{"name", clip.name},
                             {"duration", clip.duration},
                             {"channels", clip.channels},
                             {"morph_channels", clip.morph_channels},
                             {"frames", clip.frames}});
  }
  for (const auto& mesh : scene.meshes) {
    json["meshes"].push_back({{"name", mesh.name},
                              {"nodes", mesh.nodes},
                              {"vertices", mesh.vertices},
                              {"faces", mesh.faces},
                              {"bones", mesh.bones},
                              {"morph_targets", mesh.morph_targets}});
  }
  for (std::size_t joint = 0; joint < scene.skeleton.joint_names.size(); ++joint) {
    json["joints"].push_back(
        {{"name", scene.skeleton.joint_names[joint]}, {"parent", scene.skeleton.parents[joint]}});
  }
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

void print_joints(const Skeleton& skeleton) {
  if (skeleton.empty()) return;
  fmt::print("\n{} joints\n", skeleton.joint_names.size());
  std::vector<std::size_t> depth(skeleton.joint_names.size(), 0);
  for (std::size_t joint = 0; joint < depth.size(); ++joint) {
    const std::int32_t parent = skeleton.parents[joint];
    if (parent >= 0) depth[joint] = depth[static_cast<std::size_t>(parent)] + 1;
    fmt::print("  {:{}}{}\n", "", 2 * depth[joint], skeleton.joint_names[joint]);
  }
}

void print_text(const std::string& path, const std::string& fps, const SceneSummary& scene) {
  fmt::print("{}: a scene of {} clips, {} meshes and {} joints\n", path, scene.clips.size(),
             scene.meshes.size(), scene.skeleton.joint_names.size());
  for (const auto& [key, value] : scene.metadata) fmt::print("  {}: {}\n", key, value);
  if (scene.keyframes) fmt::print("  a mesh for each of {} frames\n", *scene.keyframes);
  if (!scene.clips.empty()) {
    fmt::print("\nclips\n  {:>3} {:>10} {:>9} {:>7} {:>8}  {}\n", "", "seconds", "channels", "morphs",
               "frames", "name");
  }
  for (std::size_t i = 0; i < scene.clips.size(); ++i) {
    const auto& clip = scene.clips[i];
    fmt::print("  {:>3} {:>10.4g} {:>9} {:>7} {:>8}  {}\n", i, clip.duration, clip.channels,
               clip.morph_channels, clip.frames, clip.name);
  }
  if (!scene.clips.empty()) fmt::print("  frames at {} per second\n", fps);
  if (!scene.meshes.empty()) {
    fmt::print("\nmeshes\n  {:>3} {:>9} {:>9} {:>6} {:>7}  {}\n", "", "vertices", "faces", "bones", "morphs",
               "name (nodes)");
  }
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const auto& mesh = scene.meshes[i];
    fmt::print("  {:>3} {:>9} {:>9} {:>6} {:>7}  {} ({})\n", i, mesh.vertices, mesh.faces, mesh.bones,
               mesh.morph_targets, mesh.name, fmt::join(mesh.nodes, ", "));
  }
  if (scene.welded_vertices > 0)
    fmt::print("  {} vertices once all are merged and welded\n", scene.welded_vertices);
  print_joints(scene.skeleton);
  for (const std::string& note : scene.notes) fmt::print(stderr, "note: {}\n", note);
}

}  // namespace

bool has_scene_info(const std::string& path) {
  return is_scene(path) || has_suffix(path, ".bvh");
}

void print_scene_info(const std::string& path, const std::string& fps, bool json) {
  const SceneSummary scene = summarize_scene(path, parse_rate(fps));
  json ? print_json(path, fps, scene) : print_text(path, fps, scene);
}

}  // namespace tvg::cli
