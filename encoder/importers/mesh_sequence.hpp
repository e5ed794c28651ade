#pragma once
#include "encoder/importers/mesh_file.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tvg/source.hpp>

namespace tvg::cli {

/// Finds the files of a numbered sequence ("walk_%04d.obj"), sorted by number. Throws ToolError where there
/// is none or a number is missing. Returns nothing where `path` is no such pattern, or is the name of a file
/// that exists.
std::optional<std::vector<std::string>> find_pattern_files(const std::string& path);

/// The mesh files of a folder in natural order (frame2 before frame10). Throws ToolError where there is none,
/// where formats are mixed, or where numbered names leave a number out.
std::vector<std::string> find_folder_files(const std::string& folder);

/// A mesh file with its weld, for the formats that need one.
struct WeldedMesh {
  MeshFormat format = MeshFormat::kObj;
  MeshFile mesh;
  Weld weld;                       ///< of STL; otherwise empty
  std::vector<std::string> notes;  ///< what a user may want to know: polygons triangulated, corners welded
};

/// Reads a mesh file and, for STL, welds it.
WeldedMesh read_welded_mesh(const std::string& path);

/// Frames of mesh files with one connectivity, that of the first, read one file at a time.
class MeshSequenceSource final : public FrameSource {
 public:
  /// `first` is the content of files[0]; its frame has the number `first_frame` in messages.
  MeshSequenceSource(std::vector<std::string> files, WeldedMesh first, std::uint64_t first_frame);

  const Mesh& mesh() const override { return mesh_; }
  Metadata metadata() const override;
  std::optional<std::uint64_t> frame_count() const override { return files_.size(); }
  Result<bool> read_frame(std::span<float> positions) override;
  Status skip_frames(std::uint64_t count) override;
  bool rewind() override;

 private:
  void read_positions(const std::string& path, std::span<float> positions);
  void weld_frame(const std::string& path);
  [[noreturn]] void fail_changed(const std::string& path, const std::string& difference) const;

  std::vector<std::string> files_;
  WeldedMesh first_;
  std::uint64_t first_frame_;
  Mesh mesh_;
  std::uint64_t next_ = 0;
  std::string buffer_;
  MeshFile current_;
};

}  // namespace tvg::cli
