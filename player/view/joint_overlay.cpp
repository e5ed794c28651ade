#include "player/view/joint_overlay.hpp"

#include "tool/colour_map.hpp"

#include <Eigen/Core>
#include <cmath>
#include <imgui.h>
#include <optional>
#include <vector>

namespace tvg::player {

namespace {

constexpr ImU32 kBone = IM_COL32(30, 34, 44, 150);
constexpr ImU32 kStill = IM_COL32(70, 76, 90, 220);
constexpr ImU32 kRim = IM_COL32(255, 255, 255, 235);

/// Where the joints are in the area; nothing for those behind the camera.
std::vector<std::optional<ImVec2>> project(const OrbitCamera& camera, const PictureArea& area,
                                           std::span<const float> joints) {
  const CameraMatrices matrices = camera.matrices(double{area.width} / double{area.height});
  const Eigen::Matrix4f whole = Eigen::Map<const Eigen::Matrix4f>(matrices.projection.data()) *
                                Eigen::Map<const Eigen::Matrix4f>(matrices.view.data());
  std::vector<std::optional<ImVec2>> places(joints.size() / 3);
  for (std::size_t j = 0; j < places.size(); ++j) {
    const Eigen::Vector4f clip =
        whole * Eigen::Vector4f(joints[3 * j], joints[3 * j + 1], joints[3 * j + 2], 1);
    if (!(clip.w() > 0)) continue;
    places[j] = ImVec2(area.left + area.width * (clip.x() / clip.w() + 1) / 2,
                       area.top + area.height * (1 - clip.y() / clip.w()) / 2);
  }
  return places;
}

ImU32 highlight() {
  const cli::Colour colour = cli::map_colour(cli::ColourMap::kFlags, 1);
  return ImGui::ColorConvertFloat4ToU32({colour.red, colour.green, colour.blue, 1});
}

}  // namespace

void draw_pose(ImDrawList& list, const OrbitCamera& camera, const PictureArea& area, const Pose& pose,
               float size) {
  const std::vector<std::optional<ImVec2>> places = project(camera, area, pose.joints);
  list.PushClipRect({area.left, area.top}, {area.left + area.width, area.top + area.height});
  for (std::size_t j = 0; j < places.size(); ++j) {
    const std::int32_t parent = pose.skeleton.parents[j];
    if (parent < 0 || !places[j] || !places[static_cast<std::size_t>(parent)]) continue;
    list.AddLine(*places[static_cast<std::size_t>(parent)], *places[j], kBone, 0.12F * size);
  }
  for (std::size_t j = 0; j < places.size(); ++j) {
    if (!places[j]) continue;
    const bool highlighted = pose.highlighted[j] != 0;
    const float radius = (highlighted ? 0.36F : 0.2F) * size;
    list.AddCircleFilled(*places[j], radius + 0.08F * size, kRim);
    list.AddCircleFilled(*places[j], radius, highlighted ? highlight() : kStill);
  }
  list.PopClipRect();
}

}  // namespace tvg::player
