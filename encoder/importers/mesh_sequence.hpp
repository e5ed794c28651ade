#pragma once
#include "encoder/importers/face_order.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/property_options.hpp"
#include "encoder/importers/read_notes.hpp"
#include "encoder/importers/stl_weld.hpp"
#include "encoder/importers/stretch_properties.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
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
  /// A file without faces is a frame that shows nothing: a mesh of one vertex and no faces. Else it is a gap.
  bool empty_frames = true;
  WeldTolerance weld = {};
  /// What coordinates are relative to; (0, 0, 0): to nothing. Where it is absent, the first file tells
  /// (read_located_mesh()).
  std::optional<Origin> origin = {};
  PropertyOptions properties = {};
};

/// A mesh file, welded where its format needs it (STL).
struct WeldedMesh {
  MeshFile mesh;
  StretchProperties properties;    ///< what it has beside positions, none of it animated
  std::vector<NamedData> data;     ///< its materials
  std::vector<std::string> notes;  ///< what a user may want to know: polygons triangulated, corners welded
};

/// Reads a mesh file by itself, whose positions come from elsewhere, and, for STL, welds it.
WeldedMesh read_welded_mesh(const std::string& path, const SequenceOptions& options);

/// Frames of mesh files, read one file at a time. They may have meshes of their own: a mesh that was among
/// the last few is known again, in whatever order its faces stand. Of STL, the files are read once before as
/// far as the mesh stays, to see what hangs together in every frame. Of files with attributes up to three are
/// looked at before, to see which attributes change; where one does that did not in these, the mesh is
/// another one from that file on.
class MeshSequenceSource final : public FrameSource {
 public:
  /// The first frame has the number `first_frame` in messages. Throws ImportError where the first file cannot
  /// be read.
  MeshSequenceSource(std::vector<std::string> files, const SequenceOptions& options,
                     std::uint64_t first_frame);

  const Mesh& mesh() const override { return known_->mesh; }
  const MeshProperties& properties() const override { return known_->properties.properties(); }
  std::span<const float> animated_values(std::size_t attribute) const override {
    return known_->properties.values(attribute);
  }
  std::span<const NamedData> data() const override { return data_; }
  Metadata metadata() const override;
  /// Unknown where frames may be left out.
  std::optional<std::uint64_t> frame_count() const override;
  Result<bool> read_frame(std::span<float> positions) override;
  Status skip_frames(std::uint64_t count) override;
  Result<bool> begin_next_mesh() override;
  bool mesh_may_change() const override { return files_.size() > 1; }
  bool rewind() override;

  /// On the first file, for the user.
  const std::vector<std::string>& notes() const { return notes_; }
  /// On the files that were read after it.
  const std::shared_ptr<ReadNotes>& later_notes() const { return later_; }

 private:
  /// A mesh that was met.
  struct KnownMesh {
    Mesh mesh;
    FaceOrder order;
    std::string file;
    bool shows_nothing = false;
    StretchProperties properties = {};
  };

  void begin_stretch();
  bool load_next_mesh();
  void know_mesh();
  bool is_known(KnownMesh& seen);
  void look_ahead();
  bool look_at_file(std::size_t file);
  void read_materials_of(const std::string& file);
  void read_mesh(const std::string& file, MeshFile& mesh);
  void read_values(const std::string& path);
  void tell(const std::string& file, const std::vector<std::string>& notes);
  void begin_empty_stretch(const std::string& what);
  bool load(std::size_t file);
  std::vector<float> place_of_nothing();
  std::vector<std::string> look_through_stl(const std::string& first);
  bool read_next(std::span<float> positions);
  void read_positions(const std::string& path, std::span<float> positions);
  void take_empty_frame(const std::string& what);
  void read_nothing(const std::string& path, const std::string& what, std::span<float> positions);
  [[noreturn]] void fail_changed(const std::string& path, const std::string& difference);

  std::vector<std::string> files_;
  SequenceOptions options_;
  std::uint64_t first_frame_;
  MeshFormat format_;
  std::shared_ptr<KnownMesh> known_;             // the present one
  std::deque<std::shared_ptr<KnownMesh>> seen_;  // the last few, the latest behind
  std::string name_;
  std::vector<NamedData> data_;
  std::map<std::string, std::map<std::string, std::string>> renamed_materials_;  // by file
  StlWeld stl_;
  std::size_t stretch_ = 0;  // the file that the present mesh begins with
  std::size_t next_ = 0;
  std::vector<float> last_;   // positions of the frame before, in this stretch
  std::vector<float> place_;  // of the last frame that shows something: its first vertex
  bool changed_ = false;      // the last error was another mesh
  std::string buffer_;
  MeshFile current_;
  MeshFile ahead_;                           // the last file that was looked at in advance
  std::optional<std::size_t> loaded_ahead_;  // which it is
  std::optional<std::size_t> loaded_;        // the file that current_ is as it was read
  std::vector<std::string> notes_;
  std::shared_ptr<ReadNotes> later_ = std::make_shared<ReadNotes>();
};

}  // namespace tvg::cli
