#include "encoder/importers/scene_skeleton_data.hpp"

#include "encoder/importers/scene_attributes.hpp"
#include "encoder/importers/scene_data.hpp"

#include <bit>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tvg::cli {

namespace {

void append(float value, std::vector<std::uint8_t>& bytes) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
}

}  // namespace

std::vector<NamedData> skeleton_data(const SceneSkeleton& skeleton, const SceneNodes& nodes, const Clip& clip,
                                     double fps, const FrameRange& range, std::vector<std::string>& notes) {
  nlohmann::json joints = nlohmann::json::array();
  for (std::size_t joint = 0; joint < skeleton.nodes.size(); ++joint) {
    joints.push_back({{"name", plain_name(skeleton.skeleton.joint_names[joint])},
                      {"parent", skeleton.skeleton.parents[joint]}});
  }
  std::vector<NamedData> data = {json_data("skeleton", {{"joints", std::move(joints)}})};

  const std::uint64_t frame_bytes = 3 * sizeof(float) * skeleton.nodes.size();
  const std::uint64_t frames = range.last - range.first + 1;
  if (frames > kMostDataBytes / frame_bytes) {
    notes.push_back(fmt::format("the places of its {} joints in {} frames are more than {} MiB and left out",
                                skeleton.nodes.size(), frames, kMostDataBytes >> 20));
    return data;
  }
  NamedData track{"skeleton/positions", {}};
  track.bytes.reserve(frames * frame_bytes);
  const std::vector<Transform> rest = nodes.rest_pose();
  std::vector<Transform> local, global;
  std::vector<float> places;
  for (std::uint64_t frame = range.first; frame <= range.last; ++frame) {
    clip.pose(clip.time_of(frame, fps), rest, local);
    nodes.to_scene_space(local, global);
    skeleton.pose(global, places);
    for (const float value : places) append(value, track.bytes);
  }
  data.push_back(std::move(track));
  return data;
}

}  // namespace tvg::cli
