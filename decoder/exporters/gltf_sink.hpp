#pragma once
#include "decoder/exporters/frame_sink.hpp"
#include "decoder/exporters/gltf_stretch.hpp"
#include "decoder/exporters/lost_properties.hpp"
#include "decoder/exporters/output_times.hpp"
#include "tool/origin.hpp"

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace tvg::cli {

/// The name of the buffer beside a glTF file of text: "back.bin" beside "back.gltf".
std::string buffer_beside(const std::string& gltf);

/// One glTF 2.0 file of all frames (.glb, or .gltf with its buffer beside it), with an animation that plays
/// them: a mesh with a morph target per frame, and a node per mesh where it changes, each as large as it is
/// while its frames last and of no size before and after. Nodes above turn, scale and move it as the
/// metadata's `up`, `units` and `origin` say.
class GltfSink final : public FrameSink {
 public:
  GltfSink(const std::string& path, const SinkOptions& options);
  ~GltfSink() override;

  void add_data(const NamedData& data) override;
  void begin_mesh(const Mesh& mesh, const MeshProperties& properties, const Metadata& metadata,
                  std::optional<std::uint64_t> frame_count) override;
  void write_frame(std::span<const float> positions, AnimatedValues animated = {}) override;
  void finish() override;
  const std::vector<std::string>& files() const override { return files_; }
  std::vector<std::string> notes() const override;

 private:
  void end_stretch();
  void write_nodes();
  nlohmann::json root_node() const;
  void add_sizes(nlohmann::json& animation, std::size_t node, const GltfPlacedMesh& placed, bool is_last);
  void add_weights(nlohmann::json& animation, std::size_t node, const GltfPlacedMesh& placed);
  std::size_t write_times(const std::vector<double>& times);
  double time_of(std::uint64_t frame) const;
  void complete_document();
  void write_glb();
  void write_text();

  std::string path_;
  SinkOptions options_;
  bool is_binary_;
  AtomicFile file_;                   ///< the buffer, which becomes the file itself where that is binary
  std::unique_ptr<AtomicFile> text_;  ///< the file itself where it is text
  nlohmann::json document_;
  GltfBuffer buffer_;
  GltfMaterials materials_;
  OutputTimes times_;
  LossNotes losses_;
  Metadata metadata_;
  nlohmann::json extras_;
  std::unique_ptr<GltfStretch> stretch_;
  std::vector<GltfPlacedMesh> placed_;
  std::optional<std::size_t> texcoord_sets_;  ///< that every mesh has
  std::uint64_t frames_ = 0;
  std::vector<std::string> files_;
};

}  // namespace tvg::cli
