#include "player/window/interface.hpp"

#include "player/view/axes_gizmo.hpp"
#include "player/window/info_panels.hpp"
#include "player/window/scrub_bar.hpp"
#include "player/window/theme.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <imgui.h>

namespace tvg::player {

namespace {

enum class Icon { kPlay, kPause, kBack, kOn, kLoop, kHelp };

void draw_icon(ImDrawList& list, Icon icon, ImVec2 middle, float size, ImU32 colour) {
  const auto at = [&](float x, float y) { return ImVec2{middle.x + x * size, middle.y + y * size}; };
  switch (icon) {
    case Icon::kPlay:
      list.AddTriangleFilled(at(-0.35F, -0.5F), at(0.5F, 0), at(-0.35F, 0.5F), colour);
      break;
    case Icon::kPause:
      list.AddRectFilled(at(-0.4F, -0.45F), at(-0.12F, 0.45F), colour, 1);
      list.AddRectFilled(at(0.12F, -0.45F), at(0.4F, 0.45F), colour, 1);
      break;
    case Icon::kBack:
      list.AddTriangleFilled(at(0.3F, -0.4F), at(0.3F, 0.4F), at(-0.3F, 0), colour);
      list.AddRectFilled(at(-0.45F, -0.4F), at(-0.3F, 0.4F), colour, 1);
      break;
    case Icon::kOn:
      list.AddTriangleFilled(at(-0.3F, -0.4F), at(0.3F, 0), at(-0.3F, 0.4F), colour);
      list.AddRectFilled(at(0.3F, -0.4F), at(0.45F, 0.4F), colour, 1);
      break;
    case Icon::kLoop:
      list.PathArcTo(middle, 0.4F * size, 0.6F, 5.7F, 24);
      list.PathStroke(colour, ImDrawFlags_None, size * 0.12F);
      list.AddTriangleFilled(at(0.13F, -0.25F), at(0.5F, -0.42F), at(0.45F, 0.02F), colour);
      break;
    case Icon::kHelp:
      list.AddText({middle.x - ImGui::CalcTextSize("?").x / 2, middle.y - ImGui::GetFontSize() / 2}, colour,
                   "?");
      break;
  }
}

bool icon_button(const char* name, Icon icon, const char* hint, ImU32 colour = theme::kText) {
  const float size = ImGui::GetFrameHeight();
  const bool pressed = ImGui::Button(name, {size * 1.25F, size});
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  draw_icon(*ImGui::GetWindowDrawList(), icon, {(low.x + high.x) / 2, (low.y + high.y) / 2}, size * 0.55F,
            colour);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", hint);
  ImGui::SameLine();
  return pressed;
}

void draw_transport_buttons(const PlayerSnapshot& player, InterfaceRequests& requests) {
  if (icon_button("##back", Icon::kBack, "one frame back (Left)")) requests.action = Action::kStepBack;
  const Icon icon = player.playing ? Icon::kPause : Icon::kPlay;
  if (icon_button("##play", icon, player.playing ? "pause (Space)" : "play (Space)")) {
    requests.action = Action::kTogglePlay;
  }
  if (icon_button("##on", Icon::kOn, "one frame on (Right)")) requests.action = Action::kStepForward;
  const ImU32 colour = player.looping ? theme::kAccent : theme::kFaintText;
  if (icon_button("##loop", Icon::kLoop, player.looping ? "loops (L)" : "plays once (L)", colour)) {
    requests.action = Action::kToggleLoop;
  }
}

void draw_speed(const PlayerSnapshot& player, InterfaceRequests& requests) {
  constexpr std::array kSpeeds = {0.1, 0.25, 0.5, 1.0, 2.0, 4.0};
  ImGui::SetNextItemWidth(4.2F * ImGui::GetFontSize());
  if (ImGui::BeginCombo("##speed", fmt::format("{:g}x", player.speed).c_str(),
                        ImGuiComboFlags_NoArrowButton)) {
    for (const double speed : kSpeeds) {
      if (ImGui::Selectable(fmt::format("{:g}x", speed).c_str(), speed == player.speed))
        requests.speed = speed;
    }
    ImGui::EndCombo();
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("speed (- and +)");
  ImGui::SameLine();
}

void draw_overlay_choice(const InterfaceFacts& facts, const ViewSettings& settings,
                         InterfaceRequests& requests) {
  ImGui::SetNextItemWidth(8 * ImGui::GetFontSize());
  const char* const present =
      settings.overlay == Overlay::kNone ? "no overlay" : overlay_name(settings.overlay);
  if (ImGui::BeginCombo("##overlay", present, ImGuiComboFlags_NoArrowButton)) {
    for (const Overlay overlay : {Overlay::kNone, Overlay::kImportance, Overlay::kCost, Overlay::kError}) {
      if (overlay == Overlay::kError && !facts.has_reference) continue;
      if (ImGui::Selectable(overlay_name(overlay), overlay == settings.overlay)) requests.overlay = overlay;
    }
    ImGui::EndCombo();
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("what colours the mesh (S)");
  ImGui::SameLine();
}

std::string time_text(double seconds) {
  const auto minutes = static_cast<long>(seconds / 60);
  return fmt::format("{}:{:05.2f}", minutes, seconds - 60 * static_cast<double>(minutes));
}

/// Returns where the bar begins, in pixels from the top.
float draw_transport(const PlayerSnapshot& player, const InterfaceFacts& facts, const ViewSettings& settings,
                     InterfaceRequests& requests) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  constexpr float kMargin = 14;
  ImGui::SetNextWindowPos({kMargin, size.y - kMargin}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowSize({size.x - 2 * kMargin, 0});
  ImGui::Begin("transport", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoNav);
  const float top = ImGui::GetWindowPos().y;
  requests.seek = draw_scrub_bar(player, ImGui::GetContentRegionAvail().x);
  draw_transport_buttons(player, requests);
  draw_speed(player, requests);
  draw_overlay_choice(facts, settings, requests);

  const std::uint64_t frames = player.stream.frame_count.value_or(player.stream.known_frames);
  const std::string where =
      fmt::format("{} / {}    frame {}{} / {}", time_text(static_cast<double>(player.frame) / player.rate),
                  time_text(static_cast<double>(frames) / player.rate), player.frame,
                  player.held ? " (lost)" : "", frames == 0 ? 0 : frames - 1);
  const float button = 1.25F * ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x;
  const float right = ImGui::GetWindowContentRegionMax().x - button - ImGui::CalcTextSize(where.c_str()).x;
  ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), right));
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(where.c_str());
  ImGui::SameLine();
  if (icon_button("##help", Icon::kHelp, "keys (?)")) requests.action = Action::kHelp;
  ImGui::End();
  return top;
}

void draw_axes_above(float bottom, const CameraAxes& camera) {
  const float size = ImGui::GetFontSize();
  const float inwards = axes_reach(size) + 0.8F * size;
  draw_axes(*ImGui::GetBackgroundDrawList(), camera,
            {ImGui::GetIO().DisplaySize.x - inwards, bottom - inwards, size}, true);
}

}  // namespace

InterfaceRequests draw_interface(const PlayerSnapshot* player, const InterfaceFacts& facts,
                                 const ViewSettings& settings) {
  InterfaceRequests requests;
  if (player == nullptr) {
    draw_welcome();
  } else {
    float bottom = ImGui::GetIO().DisplaySize.y;
    if (settings.interface) {
      bottom = draw_transport(*player, facts, settings, requests);
      if (settings.info) draw_info(*player, facts);
      if (settings.chart) bottom = draw_chart(*player, facts, bottom);
    }
    if (settings.axes) draw_axes_above(bottom, facts.camera);
    if (facts.legend) {
      const float size = ImGui::GetFontSize();
      draw_legend(*ImGui::GetBackgroundDrawList(), {14, 14, size}, *facts.legend);
    }
    draw_state(*player);
  }
  if (settings.help) draw_help();
  if (!facts.notice.empty()) draw_notice(facts.notice);
  return requests;
}

}  // namespace tvg::player
