#include "encoder/importers/scene_source.hpp"

#include "encoder/importers/bytes.hpp"
#include "encoder/importers/frame_times.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/keyframe_source.hpp"
#include "encoder/importers/scene_attributes.hpp"
#include "encoder/importers/scene_choice.hpp"
#include "encoder/importers/scene_normals.hpp"
#include "encoder/importers/scene_skeleton.hpp"
#include "encoder/importers/scene_skeleton_data.hpp"
#include "encoder/importers/text_cursor.hpp"
#include "tool/mesh_format.hpp"
#include "tool/option_values.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

constexpr const char* kDefaultFps = "30";

class SceneSource final : public FrameSource {
 public:
  SceneSource(const Scene& scene, Clip clip, SceneMesh mesh, double fps)
      : file_(scene.path),
        nodes_(scene.nodes),
        clip_(std::move(clip)),
        mesh_(std::move(mesh)),
        metadata_(scene.metadata),
        fps_(fps),
        frame_count_(clip_.frame_times.empty() ? clip_.frame_count(fps) : clip_.frame_times.size()),
        rest_(nodes_.rest_pose()),
        skeleton_(find_skeleton(nodes_, mesh_)) {}

  /// Before the first frame is read.
  void settle(const SceneOptions& options, const std::string& rate, const std::string& start,
              std::vector<NamedData> data, std::vector<std::string>& notes);

  const Mesh& mesh() const override { return mesh_.mesh; }
  const MeshProperties& properties() const override { return mesh_.properties; }
  std::span<const NamedData> data() const override { return data_; }
  Metadata metadata() const override { return metadata_; }
  const Skeleton& skeleton() const override { return skeleton_.skeleton; }
  std::span<const float> joint_positions() const override { return joint_positions_; }
  std::optional<std::uint64_t> frame_count() const override { return frame_count_; }
  Result<bool> read_frame(std::span<float> positions) override;
  Status skip_frames(std::uint64_t count) override {
    next_ += count;
    return {};
  }
  bool rewind() override {
    next_ = 0;
    return true;
  }

 private:
  void pose_morphs(double seconds);

  std::string file_;
  SceneNodes nodes_;
  Clip clip_;
  SceneMesh mesh_;
  Metadata metadata_;
  double fps_;
  std::uint64_t frame_count_;
  std::vector<Transform> rest_;
  SceneSkeleton skeleton_;
  std::vector<NamedData> data_;
  std::uint64_t next_ = 0;
  // Of the frame read last.
  std::vector<Transform> local_, global_, carriers_;
  std::vector<double> weights_;
  std::vector<float> joint_positions_;
};

void SceneSource::pose_morphs(double seconds) {
  weights_.assign(mesh_.slot_count, 0);
  for (const MorphSlots& slots : mesh_.slots) {
    clip_.morphs[slots.channel].weights.at(seconds, false, false,
                                           std::span(weights_).subspan(slots.first, slots.count));
  }
}

Result<bool> SceneSource::read_frame(std::span<float> positions) {
  if (next_ >= frame_count_) return false;
  const double seconds = clip_.frame_times.empty() ? clip_.time_of(next_, fps_) : clip_.frame_times[next_];
  clip_.pose(seconds, rest_, local_);
  nodes_.to_scene_space(local_, global_);
  pose_morphs(seconds);
  mesh_.pose(global_, weights_, carriers_, positions);
  skeleton_.pose(global_, joint_positions_);
  const bool joints_finite = find_non_finite(joint_positions_) == joint_positions_.size();
  if (const std::size_t bad = find_non_finite(positions); bad < positions.size() || !joints_finite) {
    const std::string what = bad < positions.size() ? fmt::format("vertex {}", bad / 3) : "a joint";
    return ImportError(
               ErrorCode::kInvalidInput,
               fmt::format("{}: in frame {} the clip moves {} to where coordinates are NaN or infinite",
                           file_, next_, what))
        .as_value();
  }
  ++next_;
  return true;
}

void SceneSource::settle(const SceneOptions& options, const std::string& rate, const std::string& start,
                         std::vector<NamedData> data, std::vector<std::string>& notes) {
  if (!start.empty()) metadata_.emplace("start", start);
  if (!rate.empty()) metadata_.emplace("fps", rate);
  // Our own clips have a name of ours.
  if (clip_.frame_times.empty() && !clip_.name.empty() && is_plain_text(clip_.name))
    metadata_.emplace("name", clip_.name);
  data_ = std::move(data);
  std::vector<std::string> found;
  if (std::ranges::any_of(mesh_.properties.attributes, [](const Attribute& attribute) {
        return attribute.kind == AttributeKind::kNormal;
      })) {
    FramePositions positions(3 * mesh_.positions.size());
    // A first frame that is refused is told when it is read.
    if (read_frame(positions)) {
      const bool is_flat = choose_normals(mesh_.mesh, mesh_.properties, positions,
                                          is_moved(mesh_, nodes_, clip_), options.properties.normals, found);
      if (is_flat) metadata_.emplace("shading", "flat");
    }
    rewind();
  }
  if (!skeleton_.nodes.empty() && options.skeleton_data) {
    FrameRange range = options.frames.value_or(FrameRange{0, frame_count_ - 1});
    range.last = std::min(range.last, frame_count_ - 1);  // what lies outside is refused later
    range.first = std::min(range.first, range.last);
    for (NamedData& piece : skeleton_data(skeleton_, nodes_, clip_, fps_, range, found))
      data_.push_back(std::move(piece));
  } else if (!skeleton_.nodes.empty() && options.properties.wanted) {
    found.push_back(fmt::format("its skeleton of {} joints is left out: `--skeleton-data` keeps it",
                                skeleton_.nodes.size()));
  }
  for (const std::string& note : found) notes.push_back(fmt::format("{}: {}", file_, note));
}

/// Bits for colours of linear light that are about as fine in the dark as 8 bits are in sRGB.
constexpr int kLinearColourBits = 12;

bool is_whole_255th(float value) {
  return std::abs(255 * value - std::round(255 * value)) < 1e-3F;
}

void refine_linear_colours(MeshProperties& properties) {
  for (Attribute& attribute : properties.attributes) {
    if (attribute.kind == AttributeKind::kColour && !std::ranges::all_of(attribute.values, is_whole_255th))
      attribute.bits = kLinearColourBits;
  }
}

void note_clips(const Scene& scene, std::size_t chosen, std::vector<std::string>& notes) {
  if (scene.clip_names.size() < 2) return;
  std::vector<std::string> others;
  for (std::size_t i = 0; i < scene.clip_names.size(); ++i) {
    if (i != chosen) others.push_back(fmt::format("\"{}\"", scene.clip_names[i]));
  }
  notes.push_back(fmt::format("{}: clip \"{}\" is taken; --clip picks another: {}", scene.path,
                              scene.clip_names[chosen], fmt::join(others, ", ")));
}

/// What the times of a clip's frames say, where it has any.
struct KeptTimes {
  explicit KeptTimes(const std::vector<double>& seconds) {
    FrameTimes times;
    for (const double time : seconds) times.add(static_cast<float>(time));
    start = times.start(1);
    rate = times.rate();
    if (rate.empty() && seconds.size() > 1) data = times.data();
  }

  std::string rate;
  std::string start;
  std::optional<NamedData> data;  ///< where frames do not follow each other at a rate
};

std::vector<Transform> places_at(const SceneNodes& nodes, const Clip& clip, double seconds) {
  std::vector<Transform> local, global;
  clip.pose(seconds, nodes.rest_pose(), local);
  nodes.to_scene_space(local, global);
  return global;
}

void note_mesh(const std::string& path, const SceneMesh& mesh, std::size_t vertices_before,
               std::vector<std::string>& notes) {
  if (mesh.parts > 1) notes.push_back(fmt::format("{}: {} meshes merged into one", path, mesh.parts));
  if (mesh.left_out > 0) {
    notes.push_back(fmt::format("{}: {} points and lines left out", path, mesh.left_out));
  }
  if (mesh.mesh.vertex_count < vertices_before) {
    notes.push_back(
        fmt::format("{}: {} vertices welded to {}, those that agree in position, weights and morph targets",
                    path, vertices_before, mesh.mesh.vertex_count));
  }
}

}  // namespace

OpenedScene open_scene(const std::string& path, const SceneOptions& options) {
  if (const auto frames = keyframe_count(path)) return open_keyframes(path, *frames, options);
  return open_scene(*read_scene(path), options);
}

OpenedScene open_scene(const SceneReader& reader, const SceneOptions& options) {
  std::string rate = options.fps.empty() ? kDefaultFps : options.fps;
  const double fps = parse_rate(rate);
  OpenedScene opened;
  const Scene& scene = reader.scene();
  const std::string& path = scene.path;
  opened.notes = scene.notes;
  Clip clip;
  if (!scene.clip_names.empty() || !options.clip.empty()) {
    const std::size_t index = options.clip.empty() ? 0 : find_clip(scene, options.clip);
    if (options.clip.empty()) note_clips(scene, index, opened.notes);
    clip = reader.read_clip(index, opened.notes);
  } else {
    opened.notes.push_back(fmt::format("{}: it holds no clip, so its one pose is the one frame", path));
  }
  if (!options.fps.empty()) clip.frame_times.clear();
  const KeptTimes kept(clip.frame_times);
  if (!clip.frame_times.empty()) rate = kept.rate;
  SceneMesh mesh = gather_meshes(reader, clip, options.meshes, options.properties.wanted, opened.notes);
  place_normals(mesh, places_at(scene.nodes, clip, clip.first));
  const std::size_t vertices_before = mesh.positions.size();
  weld(mesh);
  note_mesh(path, mesh, vertices_before, opened.notes);
  if (scene.linear_colours && options.properties.fine_linear_colours) refine_linear_colours(mesh.properties);
  auto source = std::make_unique<SceneSource>(scene, std::move(clip), std::move(mesh), fps);
  std::vector<NamedData> data;
  if (options.properties.wanted) data = reader.read_data(options.properties.embed_textures, opened.notes);
  if (kept.data) data.push_back(*kept.data);
  source->settle(options, rate, kept.start, std::move(data), opened.notes);
  opened.source = std::move(source);
  return opened;
}

}  // namespace tvg::cli
