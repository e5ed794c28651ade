#include "player/view/axes_gizmo.hpp"

#include <algorithm>
#include <array>
#include <imgui.h>

namespace tvg::player {

namespace {

constexpr float kArm = 2.4F;    // in sizes of a letter
constexpr float kBall = 0.62F;  // radius of what a letter stands on
constexpr ImU32 kLetter = IM_COL32(255, 255, 255, 255);

struct Arm {
  ImVec2 tip;
  double towards = 0;  // the viewer, -1 to 1
  ImU32 colour = 0;
  char letter = 0;
};

/// The one that points away first, so that those before it cover it.
std::array<Arm, 3> arms(const CameraAxes& camera, const TextPlace& place) {
  constexpr std::array<ImU32, 3> kColours = {IM_COL32(214, 52, 62, 255), IM_COL32(70, 154, 46, 255),
                                             IM_COL32(48, 104, 214, 255)};
  std::array<Arm, 3> result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result[axis] = {{place.x + kArm * place.size * static_cast<float>(camera.right[axis]),
                     place.y - kArm * place.size * static_cast<float>(camera.up[axis])},
                    camera.backward[axis],
                    kColours[axis],
                    static_cast<char>('X' + axis)};
  }
  std::ranges::sort(result, {}, &Arm::towards);
  return result;
}

}  // namespace

float axes_reach(float size) {
  return (kArm + kBall) * size;
}

void draw_axes(ImDrawList& list, const CameraAxes& camera, const TextPlace& place, bool letters) {
  const float size = place.size;
  for (const Arm& arm : arms(camera, place)) {
    list.AddLine({place.x, place.y}, arm.tip, arm.colour, 0.2F * size);
    list.AddCircleFilled(arm.tip, (letters ? kBall : 0.3F) * size, arm.colour, 24);
    if (!letters) continue;
    const std::array<char, 2> text = {arm.letter, '\0'};
    const float height = 0.95F * size;
    const ImVec2 extent = ImGui::GetFont()->CalcTextSizeA(height, 1e6F, 0, text.data());
    list.AddText(ImGui::GetFont(), height, {arm.tip.x - extent.x / 2, arm.tip.y - extent.y / 2}, kLetter,
                 text.data());
  }
}

}  // namespace tvg::player
