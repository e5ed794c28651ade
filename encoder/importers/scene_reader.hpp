#pragma once
#include "encoder/importers/scene_clip.hpp"
#include "encoder/importers/scene_nodes.hpp"

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/source.hpp>

namespace tvg::cli {

/// The nodes that move a skinned mesh.
struct SceneSkin {
  std::vector<std::size_t> joints;  ///< [joint], nodes
  std::vector<Transform> offsets;   ///< [joint], from the mesh's space to that of the joint
};

/// A mesh as one node holds it.
struct SceneInstance {
  std::size_t node = 0;
  std::size_t mesh = 0;
  std::optional<std::size_t> skin = {};      ///< which then places it, and not the node
  std::vector<double> weights = {};          ///< [morph target] where no clip moves them; missing ones are 0
  Transform placed = Transform::Identity();  ///< from the mesh's space to that of the node
};

/// What a scene holds, whatever it was read from. Things are known by their numbers: names need not be
/// unique.
struct Scene {
  std::string path;
  SceneNodes nodes;
  std::vector<std::string> mesh_names;  ///< [mesh]
  std::vector<SceneSkin> skins;
  std::vector<SceneInstance> instances;     ///< in the order of their nodes
  std::vector<std::string> clip_names;      ///< [clip]
  std::vector<std::string> material_names;  ///< [material], unique
  bool linear_colours = false;              ///< colours of vertices are of linear light, not sRGB
  /// Vertices, and faces, that all instances may have together.
  std::uint64_t most_vertices = std::numeric_limits<std::uint32_t>::max();
  Metadata metadata;               ///< units and up axis, where the format says them
  std::vector<std::string> notes;  ///< what is passed over in all clips

  /// Ends with ImportError (kInvalidInput) that names the file.
  [[noreturn]] void fail(const std::string& what) const;
};

/// What one joint of a skin has of a vertex.
struct JointWeight {
  std::uint32_t joint = 0;  ///< of the skin
  double weight = 0;
};

/// What a morph target moves.
struct VertexShift {
  std::uint32_t vertex = 0;
  Eigen::Vector3d delta;
};

/// A stretch of a mesh with vertices of its own. Weights and targets fit its positions; corners of faces,
/// joints and numbers are as the file has them, and gather_meshes() checks them.
struct ScenePart {
  std::vector<Eigen::Vector3d> positions;         ///< [vertex]
  std::vector<Face> faces;                        ///< [face][corner]
  std::vector<std::vector<JointWeight>> weights;  ///< [vertex], or empty where nothing is skinned
  std::vector<std::vector<VertexShift>>
      targets;                               ///< [morph target]; a vertex that stands still may be absent
  std::vector<Attribute> attributes;         ///< of vertices, a value for each; finite, v points up
  std::vector<Polygon> polygons;             ///< that became fans of faces
  std::optional<std::size_t> material = {};  ///< one of the scene's
  std::uint64_t left_out = 0;                ///< points and lines
  std::optional<Part> names = {};            ///< the object and the group, where they are not node and mesh
  std::map<std::string, std::vector<float>> values = {};  ///< of the part, by name
  std::vector<std::string> notes;                         ///< on attributes that are left out
};

/// A scene file, opened. Meshes and clips are read one at a time: a character may come with hundreds of
/// clips.
class SceneReader {
 public:
  SceneReader() = default;
  virtual ~SceneReader() = default;
  SceneReader(const SceneReader&) = delete;
  SceneReader& operator=(const SceneReader&) = delete;

  const Scene& scene() const { return scene_; }
  /// The parts of a mesh; with their attributes where those are wanted. Throws ImportError (kInvalidInput).
  virtual std::vector<ScenePart> read_mesh(std::size_t mesh, bool with_attributes) const = 0;
  /// A clip, finished, and in `notes` what is lost of it. Throws ImportError (kInvalidInput).
  virtual Clip read_clip(std::size_t clip, std::vector<std::string>& notes) const = 0;
  /// What NamedData calls "materials", "image/..." and "extras", with `embed_textures` the files of textures
  /// too, and in `notes` what is left out of them.
  virtual std::vector<NamedData> read_data(bool embed_textures, std::vector<std::string>& notes) const = 0;

 protected:
  Scene scene_;
};

/// Opens a scene, its polygons triangulated: glTF 2 through tinygltf, all else through assimp. `keyframe`
/// picks a frame of a format that holds one mesh per frame (MD2). Throws ImportError that names the file: kIo
/// where there is no such file, kInvalidInput or kTruncated for content that is refused.
std::unique_ptr<SceneReader> read_scene(const std::string& path, std::optional<std::uint32_t> keyframe = {});

}  // namespace tvg::cli
