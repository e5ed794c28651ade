#include "encoder/importers/scene_source.hpp"

#include "encoder/importers/bytes.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/keyframe_source.hpp"
#include "encoder/importers/scene_choice.hpp"
#include "encoder/importers/scene_skeleton.hpp"
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
  SceneSource(std::string file, SceneNodes nodes, Clip clip, SceneMesh mesh, Metadata metadata, double fps)
      : file_(std::move(file)),
        nodes_(std::move(nodes)),
        clip_(std::move(clip)),
        mesh_(std::move(mesh)),
        metadata_(std::move(metadata)),
        fps_(fps),
        frame_count_(clip_.frame_count(fps)),
        rest_(nodes_.rest_pose()),
        skeleton_(find_skeleton(nodes_, mesh_)) {}

  const Mesh& mesh() const override { return mesh_.mesh; }
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
  const double seconds = std::min(clip_.first + static_cast<double>(next_) / fps_, clip_.last);
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

void note_clips(const Scene& scene, std::size_t chosen, std::vector<std::string>& notes) {
  if (scene.clip_names.size() < 2) return;
  std::vector<std::string> others;
  for (std::size_t i = 0; i < scene.clip_names.size(); ++i) {
    if (i != chosen) others.push_back(fmt::format("\"{}\"", scene.clip_names[i]));
  }
  notes.push_back(fmt::format("{}: clip \"{}\" is taken; --clip picks another: {}", scene.path,
                              scene.clip_names[chosen], fmt::join(others, ", ")));
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
  const std::string rate = options.fps.empty() ? kDefaultFps : options.fps;
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
  SceneMesh mesh = gather_meshes(reader, clip, options.meshes, opened.notes);
  const std::size_t vertices_before = mesh.positions.size();
  weld(mesh);
  note_mesh(path, mesh, vertices_before, opened.notes);
  Metadata metadata = scene.metadata;
  metadata.emplace("fps", rate);
  if (!clip.name.empty() && is_plain_text(clip.name)) metadata.emplace("name", clip.name);
  opened.source = std::make_unique<SceneSource>(path, scene.nodes, std::move(clip), std::move(mesh),
                                                std::move(metadata), fps);
  return opened;
}

}  // namespace tvg::cli
