#pragma once
#include "encoder/importers/scene_reader.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tvg/source.hpp>

namespace tvg::cli {

/// What carries vertices along: a bone of a skin, or the node that holds a mesh without a skin.
struct Carrier {
  std::size_t node = 0;
  Transform offset = Transform::Identity();  ///< from the mesh's space to that of the node
  bool is_bone = false;
};

struct Influence {
  std::uint32_t carrier = 0;
  double weight = 0;  ///< those of a vertex sum to 1
};

struct MorphDelta {
  std::uint32_t slot = 0;  ///< into the weights of a frame
  Eigen::Vector3d delta;
};

/// Where the weights of a morph channel stand among those of a frame.
struct MorphSlots {
  std::size_t channel = 0;  ///< of the clip
  std::size_t first = 0;
  std::size_t count = 0;
};

/// All chosen meshes of a scene in one vertex array, ready to be posed.
struct SceneMesh {
  Mesh mesh;
  std::vector<Eigen::Vector3d> positions;    ///< [vertex], in the space of its mesh
  std::vector<std::size_t> influence_begin;  ///< [vertex + 1]
  std::vector<Influence> influences;         ///< of each vertex in order of carrier
  std::vector<std::size_t> morph_begin;      ///< [vertex + 1]
  std::vector<MorphDelta> morphs;            ///< of each vertex in order of slot
  std::vector<Carrier> carriers;
  std::vector<MorphSlots> slots;
  std::size_t slot_count = 0;
  MeshProperties properties;  ///< before weld() all attributes are of vertices
  std::size_t parts = 0;      ///< meshes merged, counted once for each node that holds them
  std::size_t left_out = 0;   ///< points and lines, which are not encoded

  std::span<const Influence> influences_of(std::size_t vertex) const;
  std::span<const MorphDelta> morphs_of(std::size_t vertex) const;
  /// Positions of all vertices, [vertex][xyz], where nodes stand at `global` ([node], to the scene's space)
  /// and morph targets have `weights` ([slot]). `scratch` is reused.
  void pose(const std::vector<Transform>& global, const std::vector<double>& weights,
            std::vector<Transform>& scratch, std::span<float> out) const;
};

/// Gathers the meshes of `wanted` (see choose_instances), in the order of the nodes that hold them; a mesh
/// that several nodes hold with one skin is taken once, because its joints place it. Morph targets that
/// `clip` moves become slots, others are applied with the weights they have. Faces of a mesh that its node
/// mirrors when the clip begins are turned, so that they look outward still. Throws ImportError
/// (kInvalidInput: no faces, bad indices, numbers that are not finite) and ToolError (kUsage: unknown names).
/// Attributes, parts and polygons come along with `with_properties`: objects are nodes, groups are meshes.
SceneMesh gather_meshes(const SceneReader& reader, const Clip& clip, const std::vector<std::string>& wanted,
                        bool with_properties, std::vector<std::string>& notes);

/// Turns normals from the spaces of their meshes to that of the scene, where nodes stand at `global`
/// ([node]), and makes them 1 long; morph targets do not count.
void place_normals(SceneMesh& mesh, const std::vector<Transform>& global);

/// Joins vertices that agree in position, influences and morph deltas to the bit, in order of first
/// appearance: a format that stores texture coordinates per vertex splits the mesh along every seam.
/// Attributes that differ there become those of corners.
void weld(SceneMesh& mesh);

}  // namespace tvg::cli
