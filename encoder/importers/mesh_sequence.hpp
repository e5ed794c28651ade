#pragma once
#include "encoder/importers/face_order.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/read_notes.hpp"
#include "encoder/importers/stl_weld.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tvg/source.hpp>

namespace tvg::cli {

/// What becomes of a frame of a sequence that is not there: no file has its number, or its file has no faces.
enum class Gaps {
  kRefuse,  ///< an error that names it; numbers with an even step have no gaps
  kHold,    ///< the frame before it is shown again
  kSkip,    ///< it is left out
};

/// How a sequence of mesh files is read.
struct SequenceOptions {
  Gaps gaps = Gaps::kRefuse;
  WeldTolerance weld = {};
  /// What coordinates are relative to; (0, 0, 0): to nothing. Where it is absent, the first file tells
  /// (read_located_mesh()).
  std::optional<Origin> origin = {};
};

/// A mesh file, welded where its format needs it (STL).
struct WeldedMesh {
  MeshFile mesh;
  std::vector<std::string> notes;  ///< what a user may want to know: polygons triangulated, corners welded
};

/// Reads a mesh file by itself and, for STL, welds it.
WeldedMesh read_welded_mesh(const std::string& path, const WeldTolerance& tolerance);

/// Frames of mesh files with one connectivity, that of the first, read one file at a time. Of STL, all files
/// are read once before, to see what hangs together in every frame.
class MeshSequenceSource final : public FrameSource {
 public:
  /// The first frame has the number `first_frame` in messages. Throws ImportError where the first file cannot
  /// be read.
  MeshSequenceSource(std::vector<std::string> files, const SequenceOptions& options,
                     std::uint64_t first_frame);

  const Mesh& mesh() const override { return mesh_; }
  Metadata metadata() const override;
  /// Unknown where frames may be left out.
  std::optional<std::uint64_t> frame_count() const override;
  Result<bool> read_frame(std::span<float> positions) override;
  Status skip_frames(std::uint64_t count) override;
  Result<bool> begin_next_mesh() override;
  bool rewind() override;

  /// On the first file, for the user.
  const std::vector<std::string>& notes() const { return notes_; }
  /// On the files that were read after it.
  const std::shared_ptr<ReadNotes>& later_notes() const { return later_; }

 private:
  void begin_stretch();
  void look_through_stl(const std::string& first);
  bool read_next(std::span<float> positions);
  void read_positions(const std::string& path, std::span<float> positions);
  void take_empty_frame(const std::string& what);
  [[noreturn]] void fail_changed(const std::string& path, const std::string& difference);

  std::vector<std::string> files_;
  SequenceOptions options_;
  std::uint64_t first_frame_;
  MeshFormat format_;
  Mesh mesh_;
  std::string name_;
  std::string mesh_file_;  // that the mesh is of
  FaceOrder order_;
  StlWeld stl_;
  std::size_t stretch_ = 0;  // the file that the present mesh begins with
  std::size_t next_ = 0;
  std::vector<float> last_;  // positions of the frame before, in this stretch
  bool changed_ = false;     // the last error was another mesh
  std::string buffer_;
  MeshFile current_;
  std::vector<std::string> notes_;
  std::shared_ptr<ReadNotes> later_ = std::make_shared<ReadNotes>();
};

}  // namespace tvg::cli
