#include "encoder/importers/scene_summary.hpp"

#include "encoder/importers/keyframe_source.hpp"
#include "encoder/importers/scene_skeleton.hpp"

#include <algorithm>

namespace tvg::cli {

namespace {

SceneSummary::MeshSummary summarize_mesh(const SceneReader& reader, std::size_t index) {
  const Scene& scene = reader.scene();
  SceneSummary::MeshSummary mesh;
  mesh.name = scene.mesh_names[index];
  for (const ScenePart& part : reader.read_mesh(index, false)) {
    mesh.vertices += part.positions.size();
    mesh.faces += part.faces.size();
    mesh.morph_targets = std::max<std::uint64_t>(mesh.morph_targets, part.targets.size());
  }
  for (const SceneInstance& instance : scene.instances) {
    if (instance.mesh != index) continue;
    mesh.nodes.push_back(scene.nodes.list()[instance.node].name);
    if (instance.skin) {
      mesh.bones = std::max<std::uint64_t>(mesh.bones, scene.skins[*instance.skin].joints.size());
    }
  }
  return mesh;
}

}  // namespace

SceneSummary summarize_scene(const std::string& path, double fps) {
  SceneSummary summary;
  summary.keyframes = keyframe_count(path);
  const std::unique_ptr<SceneReader> reader =
      read_scene(path, summary.keyframes ? std::optional(0u) : std::nullopt);
  const Scene& scene = reader->scene();
  summary.metadata = scene.metadata;
  summary.notes = scene.notes;
  Clip first;
  for (std::size_t i = 0; i < scene.clip_names.size(); ++i) {
    std::vector<std::string> notes;
    Clip clip = reader->read_clip(i, notes);
    summary.clips.push_back(
        {clip.name, clip.duration(), clip.nodes.size(), clip.morphs.size(), clip.frame_count(fps)});
    if (i > 0) continue;
    first = std::move(clip);
    summary.notes.insert(summary.notes.end(), notes.begin(), notes.end());
  }
  if (scene.mesh_names.empty()) {
    summary.skeleton = find_moved_nodes(scene.nodes, first).skeleton;
    return summary;
  }
  SceneMesh mesh = gather_meshes(*reader, first, {}, false, summary.notes);
  for (std::size_t i = 0; i < scene.mesh_names.size(); ++i)
    summary.meshes.push_back(summarize_mesh(*reader, i));
  weld(mesh);
  summary.welded_vertices = mesh.mesh.vertex_count;
  summary.skeleton = find_skeleton(scene.nodes, mesh).skeleton;
  return summary;
}

}  // namespace tvg::cli
