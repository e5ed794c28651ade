#pragma once
#include "decoder/exporters/gltf_buffer.hpp"
#include "decoder/exporters/mesh_frame.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include <tvg/render_view.hpp>

namespace tvg::cli {

/// The attributes of a mesh's render vertices in its first frame, in the buffer.
struct GltfAttributes {
  nlohmann::json accessors = nlohmann::json::object();  ///< by glTF's names, as a primitive has them
  /// What attributes are called, by glTF's names, where that is another name.
  nlohmann::json names = nlohmann::json::object();
  std::size_t texcoord_sets = 0;
  std::optional<std::size_t> normal;  ///< which of the properties' attributes NORMAL is
  std::vector<float> normals;         ///< [render vertex][xyz]; empty where there are none
};

/// Writes all attributes that render vertices can have: texture coordinates turned over (v points down in
/// glTF), normals of length 1, colours (bytes where they are), and others under names with an underscore.
GltfAttributes write_gltf_attributes(const RenderView& view, const MeshFrame& frame, GltfBuffer& buffer);

/// The values of normals of a frame for render vertices, of length 1; (0, 0, 1) for none.
std::vector<float> gltf_normals(const RenderView& view, std::size_t attribute, std::span<const float> values);

}  // namespace tvg::cli
