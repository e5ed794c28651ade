#include "encoder/importers/gltf_reader.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/scene_source.hpp"
#include "fuzz/require.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

// A whole glTF file, from its bytes to frames. Buffers are in the file itself.

namespace {

using namespace tvg::cli;

constexpr GltfLimits kLimits = {std::uint64_t{1} << 18, 16};
constexpr int kMostFrames = 3;

std::string no_file(const std::string& uri) {
  throw ImportError(tvg::ErrorCode::kIo, uri);
}

void require_fitting(const tvg::FrameSource& source) {
  const tvg::MeshProperties& properties = source.properties();
  const std::size_t faces = source.mesh().faces.size();
  tvg::fuzz::require(properties.attributes.size() <= tvg::kMaxAttributes);
  for (const tvg::Attribute& attribute : properties.attributes) {
    const std::size_t count = attribute.value_count();
    tvg::fuzz::require(count * attribute.components == attribute.values.size());
    for (const float value : attribute.values) tvg::fuzz::require(std::isfinite(value));
    if (attribute.domain == tvg::AttributeDomain::kVertex)
      tvg::fuzz::require(count == source.mesh().vertex_count);
    if (attribute.domain != tvg::AttributeDomain::kCorner) continue;
    tvg::fuzz::require(attribute.corners.size() == 3 * faces);
    for (const std::uint32_t value : attribute.corners) tvg::fuzz::require(value < count);
  }
  tvg::fuzz::require(properties.face_parts.size() == (properties.parts.empty() ? 0 : faces));
  for (const std::uint32_t part : properties.face_parts) tvg::fuzz::require(part < properties.parts.size());
  for (const tvg::NamedData& data : source.data())
    tvg::fuzz::require(!data.name.empty() && data.name.size() <= 1024 && tvg::is_metadata_text(data.name));
}

void read_frames(const SceneReader& reader, const SceneOptions& options) {
  const OpenedScene opened = open_scene(reader, options);
  tvg::FrameSource& source = *opened.source;
  const tvg::Mesh& mesh = source.mesh();
  for (const tvg::Face& face : mesh.faces) {
    for (const std::uint32_t vertex : face) tvg::fuzz::require(vertex < mesh.vertex_count);
  }
  require_fitting(source);
  tvg::FramePositions positions(3 * std::size_t{mesh.vertex_count});
  for (int frame = 0; frame < kMostFrames; ++frame) {
    const auto read = source.read_frame(positions);
    if (!read || !*read) return;
    for (const float value : positions) tvg::fuzz::require(std::isfinite(value));
    tvg::fuzz::require(source.joint_positions().size() == 3 * source.skeleton().joint_names.size());
  }
}

}  // namespace

/// The input: the number of a clip and of a mesh, 15 for any, and the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const int clip = data[0] & 15;
  const int mesh = data[0] >> 4;
  SceneOptions options;
  options.fps = "10";
  options.skeleton_data = true;
  options.properties.normals = NormalsChoice::kKeep;
  if (clip < 15) options.clip = std::to_string(clip);
  if (mesh < 15) options.meshes.push_back(std::to_string(mesh));
  try {
    const auto reader =
        parse_gltf_scene("fuzz", {reinterpret_cast<const char*>(data + 1), size - 1}, no_file, kLimits);
    if (reader != nullptr) read_frames(*reader, options);
  } catch (const ToolError&) {
    // An answer as good as any.
  }
  return 0;
}
