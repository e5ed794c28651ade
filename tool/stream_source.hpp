#pragma once
#include "tool/stream_reader.hpp"

#include <memory>
#include <string>

#include <tvg/source.hpp>

namespace tvg::cli {

/// Whether a path names a .tvg; nothing else is behind a URL.
bool is_stream_file(const std::string& path);

/// The frames of a .tvg as a source. A damaged stream yields an error, whose message names the file; so does
/// another mesh, with which begin_next_mesh() goes on.
class StreamSource final : public FrameSource {
 public:
  /// Reads up to the mesh. Throws ToolError when the stream cannot be opened or has no mesh.
  explicit StreamSource(std::string path);

  const Mesh& mesh() const override { return mesh_; }
  const MeshProperties& properties() const override { return properties_; }
  std::span<const float> animated_values(std::size_t attribute) const override {
    return reader_->decoder().animated_values(attribute);
  }
  Metadata metadata() const override { return reader_->decoder().metadata(); }
  /// What comes before the first mesh.
  std::span<const NamedData> data() const override { return data_; }
  std::optional<std::uint64_t> frame_count() const override { return frame_count_; }
  Result<bool> read_frame(std::span<float> positions) override;
  Result<bool> begin_next_mesh() override;
  bool mesh_may_change() const override { return true; }
  bool rewind() override;

 private:
  void open();
  void take_mesh();
  void take_data(const CodedData& coded);
  Error named(Error error) const;

  std::string path_;
  std::unique_ptr<StreamReader> reader_;
  Mesh mesh_;
  MeshProperties properties_;
  std::vector<NamedData> data_;
  bool changed_ = false;  // the last error was another mesh
  std::optional<std::uint64_t> frame_count_;
};

}  // namespace tvg::cli
