#include "player/window/theme.hpp"

#include "player/view/text_layer.hpp"

#include <cmath>

namespace tvg::player::theme {

void apply(float scale) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 9;
  style.FrameRounding = 6;
  style.PopupRounding = 6;
  style.GrabRounding = 6;
  style.WindowBorderSize = 0;
  style.FrameBorderSize = 0;
  style.WindowPadding = {14, 11};
  style.FramePadding = {9, 5};
  style.ItemSpacing = {9, 6};
  const auto colour = [](ImU32 packed) { return ImGui::ColorConvertU32ToFloat4(packed); };
  style.Colors[ImGuiCol_Text] = colour(kText);
  style.Colors[ImGuiCol_TextDisabled] = colour(kFaintText);
  style.Colors[ImGuiCol_WindowBg] = colour(kPanel);
  style.Colors[ImGuiCol_PopupBg] = colour(IM_COL32(28, 32, 40, 246));
  style.Colors[ImGuiCol_Button] = colour(IM_COL32(255, 255, 255, 18));
  style.Colors[ImGuiCol_ButtonHovered] = colour(IM_COL32(255, 255, 255, 46));
  style.Colors[ImGuiCol_ButtonActive] = colour(IM_COL32(255, 158, 74, 150));
  style.Colors[ImGuiCol_FrameBg] = colour(IM_COL32(255, 255, 255, 18));
  style.Colors[ImGuiCol_FrameBgHovered] = colour(IM_COL32(255, 255, 255, 40));
  style.Colors[ImGuiCol_FrameBgActive] = colour(IM_COL32(255, 255, 255, 40));
  style.Colors[ImGuiCol_Header] = colour(IM_COL32(255, 158, 74, 90));
  style.Colors[ImGuiCol_HeaderHovered] = colour(IM_COL32(255, 158, 74, 130));
  style.Colors[ImGuiCol_HeaderActive] = colour(IM_COL32(255, 158, 74, 170));
  style.Colors[ImGuiCol_CheckMark] = colour(kAccent);
  style.ScaleAllSizes(scale);
  load_font(std::round(15 * scale));
}

}  // namespace tvg::player::theme
