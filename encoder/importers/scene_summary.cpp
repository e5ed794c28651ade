#include "encoder/importers/scene_summary.hpp"

#include "encoder/importers/keyframe_source.hpp"
#include "encoder/importers/scene_file.hpp"
#include "encoder/importers/scene_skeleton.hpp"

#include <algorithm>
#include <assimp/scene.h>

namespace tvg::cli {

namespace {

std::vector<SceneSummary::MeshSummary> summarize_meshes(const aiScene& scene, const SceneNodes& nodes) {
  std::vector<SceneSummary::MeshSummary> meshes;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& source = *scene.mMeshes[i];
    SceneSummary::MeshSummary mesh;
    mesh.name = source.mName.C_Str();
    mesh.vertices = source.mNumVertices;
    mesh.bones = source.mNumBones;
    mesh.morph_targets = source.mNumAnimMeshes;
    mesh.faces =
        static_cast<std::uint64_t>(std::count_if(source.mFaces, source.mFaces + source.mNumFaces,
                                                 [](const aiFace& face) { return face.mNumIndices == 3; }));
    for (const SceneNode& node : nodes.list()) {
      const unsigned* held = node.source->mMeshes;
      if (std::find(held, held + node.source->mNumMeshes, i) != held + node.source->mNumMeshes) {
        mesh.nodes.push_back(node.name);
      }
    }
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

}  // namespace

SceneSummary summarize_scene(const std::string& path, double fps) {
  SceneSummary summary;
  const SceneFile file(path, (summary.keyframes = keyframe_count(path)) ? std::optional(0u) : std::nullopt);
  const aiScene& scene = file.scene();
  const SceneNodes nodes(scene);
  summary.metadata = file.metadata();
  Clip first;
  for (unsigned i = 0; i < scene.mNumAnimations; ++i) {
    Clip clip = read_clip(file, nodes, i);
    summary.clips.push_back(
        {clip.name, clip.duration(), clip.nodes.size(), clip.morphs.size(), clip.frame_count(fps)});
    if (i == 0) first = std::move(clip);
  }
  if (scene.mNumMeshes == 0) {
    summary.skeleton = find_moved_nodes(nodes, first).skeleton;
    return summary;
  }
  SceneMesh mesh = gather_meshes(file, nodes, first, {});
  summary.meshes = summarize_meshes(scene, nodes);
  weld(mesh);
  summary.welded_vertices = mesh.mesh.vertex_count;
  summary.skeleton = find_skeleton(nodes, mesh).skeleton;
  return summary;
}

}  // namespace tvg::cli
