#pragma once
#include "decoder/exporters/frame_sink.hpp"
#include "tool/atomic_file.hpp"
#include "tool/origin.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tvg::cli {

enum class CacheFormat { kPc2, kMdd };

/// The name of the mesh beside a cache: "back.obj" beside "back.pc2".
std::string mesh_beside(const std::string& cache);

/// A vertex cache, and the mesh with its first frame as OBJ beside it. One connectivity only. Where the
/// number of frames was unknown or comes out different, the header is corrected in finish().
class CacheSink final : public FrameSink {
 public:
  CacheSink(const std::string& path, CacheFormat format, const SinkOptions& options);

  void begin_mesh(const Mesh& mesh, const Metadata& metadata,
                  std::optional<std::uint64_t> frame_count) override;
  void write_frame(std::span<const float> positions) override;
  void finish() override;
  const std::vector<std::string>& files() const override { return files_; }
  std::vector<std::string> notes() const override;

 private:
  std::string format_name() const { return format_ == CacheFormat::kPc2 ? "PC2" : "MDD"; }
  std::string fixed_header(std::uint64_t frames) const;   // all but MDD's times
  std::uint64_t header_size(std::uint64_t frames) const;  // with the times
  std::string mdd_times(std::uint64_t first, std::uint64_t end) const;
  void write_header();
  void correct_header();
  void write_mesh_beside(std::span<const float> positions);
  void check_mesh_beside() const;

  AtomicFile file_;
  CacheFormat format_;
  std::string mesh_path_;  // empty where no mesh is wanted
  std::optional<AtomicFile> mesh_file_;
  bool begun_ = false;
  Mesh mesh_;
  std::string name_;
  Origin origin_{};
  double seconds_per_frame_ = 1;
  std::uint64_t promised_ = 0;  // frames in the header
  std::uint64_t frames_ = 0;    // frames written
  std::vector<char> bytes_;     // of one frame
  std::vector<std::string> files_;
};

}  // namespace tvg::cli
