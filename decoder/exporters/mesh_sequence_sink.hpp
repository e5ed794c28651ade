#pragma once
#include "decoder/exporters/frame_sink.hpp"
#include "decoder/exporters/lost_properties.hpp"
#include "tool/atomic_file.hpp"
#include "tool/frame_pattern.hpp"
#include "tool/mesh_format.hpp"
#include "tool/origin.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tvg::cli {

class MaterialFiles;

/// The name of the materials beside a sequence: "back.mtl" beside "back.obj" and "back_%04d.obj".
std::string materials_of_sequence(const std::string& path);

/// The pattern of the files of a plain name, where more than one frame comes: "folder/back.obj" becomes
/// "folder/back_%04d.obj".
std::string numbered_name(const std::string& path);

/// One mesh file per frame; the mesh may change between frames. A frame's file is complete and in place when
/// the next frame begins. Materials of OBJ are written once, in finish().
class MeshSequenceSink final : public FrameSink {
 public:
  /// `path` is a pattern or a plain name; the latter is kept where one frame comes.
  MeshSequenceSink(const std::string& path, MeshFormat format, const SinkOptions& options);
  ~MeshSequenceSink() override;

  void add_data(const NamedData& data) override;
  void begin_mesh(const Mesh& mesh, const MeshProperties& properties, const Metadata& metadata,
                  std::optional<std::uint64_t> frame_count) override;
  void write_frame(std::span<const float> positions, AnimatedValues animated = {}) override;
  void finish() override;
  const std::vector<std::string>& files() const override { return files_; }
  std::vector<std::string> files_beside() const override { return files_beside_; }
  std::vector<std::string> notes() const override;

 private:
  void finish_file(const std::string& path);

  std::string plain_name_;  // empty where the user gave a pattern
  FramePattern pattern_;
  MeshFormat format_;
  SinkOptions options_;
  Mesh mesh_;
  bool shows_nothing_ = false;
  MeshProperties properties_;
  std::unique_ptr<MaterialFiles> materials_;  // of OBJ
  LossNotes losses_;
  std::string object_name_;
  Origin origin_{};
  std::unique_ptr<AtomicFile> last_;  // the frame written last, not in place yet
  std::uint64_t frames_ = 0;          // in place
  std::vector<std::string> files_;
  std::vector<std::string> files_beside_;
};

}  // namespace tvg::cli
