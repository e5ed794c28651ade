#pragma once
#include "decoder/exporters/frame_sink.hpp"
#include "decoder/exporters/gltf_attributes.hpp"
#include "decoder/exporters/gltf_buffer.hpp"
#include "decoder/exporters/gltf_materials.hpp"
#include "tool/atomic_file.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tvg/render_view.hpp>

namespace tvg::cli {

/// A stretch of frames of one mesh in a glTF file, and how a node places the mesh.
struct GltfPlacedMesh {
  std::optional<std::size_t> mesh;  ///< of the document; none where there is nothing to draw
  std::uint64_t first_frame = 0;
  std::uint64_t frames = 0;
  std::array<double, 3> translation{};  ///< of quantized positions
  double scale = 1;
};

/// Writes the frames of one mesh: the first is the mesh itself, and each one behind it a morph target that
/// holds how far its vertices are from there. Holds a few frames at a time.
class GltfStretch {
 public:
  /// `scratch`: where positions that are to be quantized wait for their bounds; null for float32 positions.
  /// Throws ToolError where the mesh has too many vertices for an index buffer.
  GltfStretch(Mesh mesh, MeshProperties properties, std::uint64_t first_frame,
              std::unique_ptr<AtomicFile> scratch);
  ~GltfStretch();

  void add_frame(std::span<const float> positions, AnimatedValues animated, GltfBuffer& buffer);
  /// Describes the mesh in the document. All of its frames have come.
  GltfPlacedMesh finish(nlohmann::json& document, GltfBuffer& buffer, GltfMaterials& materials);

  /// Those of texture coordinates that the mesh has.
  std::size_t texcoord_sets() const { return attributes_.texcoord_sets; }

 private:
  void write_base(GltfBuffer& buffer);
  void write_target(const MeshFrame& frame, GltfBuffer& buffer);
  std::size_t write_differences(std::span<const float> values, std::span<const float> base,
                                GltfBuffer& buffer);
  void keep_for_later(std::span<const float> positions);
  void write_quantized(GltfPlacedMesh& placed, GltfBuffer& buffer);
  std::span<const float> spread_positions(std::span<const float> positions);
  nlohmann::json primitives(GltfBuffer& buffer, GltfMaterials& materials) const;

  Mesh mesh_;
  MeshProperties properties_;
  RenderView view_;
  std::uint64_t first_frame_;
  std::uint64_t frames_ = 0;
  GltfAttributes attributes_;
  nlohmann::json targets_ = nlohmann::json::array();
  std::vector<float> first_;       ///< positions of the first frame, [vertex][xyz]
  std::vector<float> base_;        ///< the same of render vertices
  std::vector<float> spread_;      ///< of render vertices in another frame
  std::vector<float> difference_;  ///< [render vertex][xyz]
  std::unique_ptr<AtomicFile> scratch_;
  std::array<double, 3> least_{}, most_{};
  double farthest_ = 0;  ///< that a coordinate gets from where it is first
};

}  // namespace tvg::cli
