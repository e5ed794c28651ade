#pragma once
#include "decoder/exporters/frame_sink.hpp"
#include "decoder/exporters/lost_properties.hpp"
#include "decoder/exporters/output_times.hpp"
#include "tool/atomic_file.hpp"
#include "tool/origin.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tvg::cli {

class MaterialFiles;

enum class CacheFormat { kPc2, kMdd, kNpy };

/// The name of the mesh beside a cache: "back.obj" beside "back.pc2".
std::string mesh_beside(const std::string& cache);

/// The name of the materials beside a mesh: "back.mtl" beside "back.obj".
std::string materials_beside(const std::string& mesh);

/// A vertex cache, and the mesh with its first frame and all that OBJ can hold beside it. One mesh only.
/// Where the number of frames was unknown or comes out different, the header is corrected in finish().
class CacheSink final : public FrameSink {
 public:
  CacheSink(const std::string& path, CacheFormat format, const SinkOptions& options);
  ~CacheSink() override;

  void add_data(const NamedData& data) override;
  void begin_mesh(const Mesh& mesh, const MeshProperties& properties, const Metadata& metadata,
                  std::optional<std::uint64_t> frame_count) override;
  void write_frame(std::span<const float> positions, AnimatedValues animated = {}) override;
  void finish() override;
  const std::vector<std::string>& files() const override { return files_; }
  std::vector<std::string> files_beside() const override { return files_beside_; }
  std::vector<std::string> notes() const override;

 private:
  std::string format_name() const;
  std::string fixed_header(std::uint64_t frames) const;   // all but MDD's times
  std::uint64_t header_size(std::uint64_t frames) const;  // with the times
  std::string mdd_times(std::uint64_t first, std::uint64_t end) const;
  void write_header();
  void correct_header();
  void write_mesh_beside(std::span<const float> positions, AnimatedValues animated);

  AtomicFile file_;
  CacheFormat format_;
  std::string mesh_path_;  // empty where no mesh is wanted
  std::optional<AtomicFile> mesh_file_;
  bool begun_ = false;
  Mesh mesh_;
  MeshProperties properties_;
  std::unique_ptr<MaterialFiles> materials_;
  LossNotes losses_;
  std::string name_;
  Origin origin_{};
  OutputTimes times_;
  bool times_written_ = false;  // with the header, and known by then
  std::uint64_t promised_ = 0;  // frames in the header
  std::uint64_t frames_ = 0;    // frames written
  std::vector<char> bytes_;     // of one frame
  std::vector<std::string> files_;
  std::vector<std::string> files_beside_;
};

}  // namespace tvg::cli
