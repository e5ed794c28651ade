#include "encoder/importers/keyframe_source.hpp"

#include "encoder/importers/bytes.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/input_file.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/scene_attributes.hpp"
#include "encoder/importers/scene_mesh.hpp"
#include "encoder/importers/scene_normals.hpp"
#include "tool/option_values.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

/// Where a format's header counts its frames, and whether assimp gives others than the first.
struct KeyframeFormat {
  const char* signature;
  std::size_t count_offset;
  bool is_read;
};

constexpr std::array<KeyframeFormat, 7> kFormats = {{{"IDP2", 40, true},
                                                     {"IDP3", 76, false},
                                                     {"IDPC", 76, false},
                                                     {"IDPO", 68, false},
                                                     {"MDL3", 68, false},
                                                     {"MDL4", 68, false},
                                                     {"MDL5", 68, false}}};

constexpr std::size_t kHeaderSize = 80;
constexpr std::uint32_t kMostKeyframes = 65536;

/// One frame as it stands, all vertices apart.
struct Keyframe {
  SceneMesh mesh;
  FramePositions positions;
  std::vector<NamedData> data = {};  ///< of the first frame
};

Keyframe read_keyframe(const std::string& path, std::uint32_t frame, const SceneOptions& options,
                       std::vector<std::string>& notes) {
  const std::unique_ptr<SceneReader> reader = read_scene(path, frame);
  const SceneNodes& nodes = reader->scene().nodes;
  const bool with_properties = frame == 0 && options.properties.wanted;
  Keyframe keyframe{gather_meshes(*reader, {}, options.meshes, with_properties, notes), {}};
  std::vector<Transform> global, scratch;
  nodes.to_scene_space(nodes.rest_pose(), global);
  keyframe.positions.resize(3 * keyframe.mesh.positions.size());
  keyframe.mesh.pose(global, {}, scratch, keyframe.positions);
  if (const std::size_t bad = find_non_finite(keyframe.positions); bad < keyframe.positions.size()) {
    reader->scene().fail(
        fmt::format("frame {}, vertex {} has a coordinate that is NaN or infinite", frame, bad / 3));
  }
  if (with_properties) {
    place_normals(keyframe.mesh, global);
    keyframe.data = reader->read_data(options.properties.embed_textures, notes);
  }
  return keyframe;
}

class KeyframeSource final : public FrameSource {
 public:
  KeyframeSource(std::string path, std::uint32_t frames, SceneOptions options,
                 std::vector<std::string>& notes)
      : path_(std::move(path)), frames_(frames), options_(std::move(options)) {
    std::vector<std::string> found;
    Keyframe first = read_keyframe(path_, 0, options_, found);
    faces_ = std::move(first.mesh.mesh.faces);
    parts_ = first.mesh.parts;
    vertex_of_.assign(first.mesh.positions.size(), 0);
    split(first.positions);
    for (std::uint32_t frame = 1; frame < frames_; ++frame) split(read_checked(frame).positions);
    mesh_.vertex_count = vertex_count_;
    mesh_.faces = faces_;
    for (Face& face : mesh_.faces) {
      for (std::uint32_t& index : face) index = vertex_of_[index];
    }
    settle(first, found);
    notes.insert(notes.end(), found.begin(), found.end());
  }

  const Mesh& mesh() const override { return mesh_; }
  const MeshProperties& properties() const override { return properties_; }
  std::span<const NamedData> data() const override { return data_; }
  Metadata metadata() const override {
    Metadata metadata;
    if (!options_.fps.empty()) metadata.emplace("fps", options_.fps);
    if (is_flat_) metadata.emplace("shading", "flat");
    return metadata;
  }
  std::optional<std::uint64_t> frame_count() const override { return frames_; }
  Result<bool> read_frame(std::span<float> positions) override;
  Status skip_frames(std::uint64_t count) override {
    next_ += count;
    return {};
  }
  bool rewind() override {
    next_ = 0;
    return true;
  }

  std::size_t parts() const { return parts_; }
  std::size_t vertices_before_weld() const { return vertex_of_.size(); }

 private:
  Keyframe read_checked(std::uint32_t frame) const {
    std::vector<std::string> notes;
    Keyframe keyframe = read_keyframe(path_, frame, options_, notes);
    if (keyframe.mesh.mesh.faces != faces_ || keyframe.mesh.positions.size() != vertex_of_.size()) {
      throw ImportError(ErrorCode::kInvalidInput,
                        fmt::format("{}: frame {} has other faces than frame 0", path_, frame));
    }
    return keyframe;
  }

  /// Parts vertices that have been taken for one and lie apart in this frame.
  void split(const FramePositions& positions) {
    using Place = std::array<float, 3>;
    const auto place_of = [&positions](std::uint32_t vertex) {
      const std::size_t x = 3 * std::size_t{vertex};
      return Place{positions[x], positions[x + 1], positions[x + 2]};
    };
    const auto hash = [&](std::uint32_t vertex) {
      std::uint64_t mixed = mix_hash(0, vertex_of_[vertex]);
      for (const float x : place_of(vertex)) mixed = mix_hash(mixed, std::bit_cast<std::uint32_t>(x + 0.0F));
      return mixed;
    };
    Weld weld = weld_points(vertex_of_.size(), hash, [&](std::uint32_t a, std::uint32_t b) {
      return vertex_of_[a] == vertex_of_[b] && place_of(a) == place_of(b);
    });
    vertex_count_ = weld.vertex_count();
    vertex_of_ = std::move(weld.vertex_of_point);
  }

  /// What the mesh has beside its faces, of the first frame.
  void settle(Keyframe& first, std::vector<std::string>& notes) {
    data_ = std::move(first.data);
    properties_ = std::move(first.mesh.properties);
    FramePositions positions(3 * std::size_t{vertex_count_});
    place(first.positions, positions);
    for (Attribute& attribute : properties_.attributes)
      attribute = with_joined_vertices(attribute, faces_, vertex_of_, vertex_count_);
    std::vector<std::string> found;
    is_flat_ = choose_normals(mesh_, properties_, positions, frames_ > 1, options_.properties.normals, found);
    for (const std::string& note : found) notes.push_back(fmt::format("{}: {}", path_, note));
  }

  /// To where vertices are after the weld.
  void place(const FramePositions& apart, std::span<float> positions) const {
    for (std::size_t vertex = 0; vertex < vertex_of_.size(); ++vertex) {
      std::memcpy(&positions[3 * std::size_t{vertex_of_[vertex]}], &apart[3 * vertex], 3 * sizeof(float));
    }
  }

  std::string path_;
  std::uint32_t frames_;
  SceneOptions options_;
  std::vector<Face> faces_;               // before the weld
  std::vector<std::uint32_t> vertex_of_;  // [vertex before the weld]
  std::uint32_t vertex_count_ = 0;
  std::size_t parts_ = 0;
  Mesh mesh_;
  MeshProperties properties_;
  bool is_flat_ = false;
  std::vector<NamedData> data_;
  std::uint64_t next_ = 0;
};

Result<bool> KeyframeSource::read_frame(std::span<float> positions) {
  if (next_ >= frames_) return false;
  try {
    place(read_checked(static_cast<std::uint32_t>(next_)).positions, positions);
  } catch (const ImportError& error) {
    return error.as_value();
  } catch (const ToolError& error) {
    return ImportError(ErrorCode::kInvalidInput, error.what()).as_value();
  }
  ++next_;
  return true;
}

}  // namespace

std::optional<std::uint32_t> keyframe_count(const std::string& path) {
  require_regular_file(path);
  InputFile file(path);
  std::array<char, kHeaderSize> header{};
  const std::size_t size = file.read(header.data(), header.size());
  for (const KeyframeFormat& format : kFormats) {
    if (size < format.count_offset + 4 || std::memcmp(header.data(), format.signature, 4) != 0) continue;
    const auto count = load<std::uint32_t>(header.data() + format.count_offset, false);
    if (count == 0 || count > kMostKeyframes) {
      throw ImportError(
          ErrorCode::kInvalidInput,
          fmt::format("{}: its header says {} frames; 1 to {} are read", path, count, kMostKeyframes));
    }
    if (format.is_read) return count;
    if (count == 1) return std::nullopt;
    throw ImportError(
        ErrorCode::kInvalidInput,
        fmt::format(
            "{}: it holds a mesh for each of {} frames, and of its format only the first can be read; "
            "MD2 is read whole, as are skinned formats and sequences of mesh files",
            path, count));
  }
  return std::nullopt;
}

OpenedScene open_keyframes(const std::string& path, std::uint32_t frames, const SceneOptions& options) {
  if (!options.clip.empty()) {
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("--clip {}: {} holds {} frames and no clips; --frames A-B picks some of them",
                                options.clip, path, frames));
  }
  if (!options.fps.empty()) parse_rate(options.fps);
  OpenedScene opened;
  auto source = std::make_unique<KeyframeSource>(path, frames, options, opened.notes);
  if (source->parts() > 1) {
    opened.notes.push_back(fmt::format("{}: {} meshes merged into one", path, source->parts()));
  }
  if (source->mesh().vertex_count < source->vertices_before_weld()) {
    opened.notes.push_back(fmt::format("{}: {} vertices welded to {}, those that coincide in every frame",
                                       path, source->vertices_before_weld(), source->mesh().vertex_count));
  }
  opened.source = std::move(source);
  return opened;
}

}  // namespace tvg::cli
