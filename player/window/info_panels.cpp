#include "player/window/info_panels.hpp"

#include "player/window/theme.hpp"
#include "tool/option_values.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>

namespace tvg::player {

namespace {

constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
constexpr float kMargin = 14;

void text(const std::string& line) {
  ImGui::TextUnformatted(line.c_str());
}

/// A panel whose pivot (0 to 1 of its own size) lies at a place of the window.
void begin_panel(const char* name, ImVec2 place, ImVec2 pivot, ImGuiWindowFlags more = 0) {
  ImGui::SetNextWindowPos(place, ImGuiCond_Always, pivot);
  ImGui::Begin(name, nullptr, kPanel | more);
}

void row(const char* name, const std::string& value) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", name);
  ImGui::TableNextColumn();
  text(value);
}

std::string bit_rate(double bits_per_second) {
  return bits_per_second <= 0       ? "-"
         : bits_per_second < 1000e3 ? fmt::format("{:.0f} kbit/s", bits_per_second / 1e3)
                                    : fmt::format("{:.2f} Mbit/s", bits_per_second / 1e6);
}

void stream_rows(const PlayerSnapshot& player) {
  const LoaderSnapshot& stream = player.stream;
  if (stream.mesh) {
    row("mesh", fmt::format("{} vertices, {} faces", stream.mesh->vertex_count, stream.mesh->faces.size()));
  }
  if (stream.lod > 0) {
    row("lod",
        fmt::format("{} of {}, {} read", stream.lod, stream.lods, cli::readable_bytes(stream.bytes_read)));
  }
  const std::string frames = stream.frame_count ? std::to_string(*stream.frame_count)
                                                : fmt::format("{} so far", stream.known_frames);
  row("frames", fmt::format("{} at {:g} per second", frames, player.rate));
  row("rate", bit_rate(player.bits_per_second));
  if (stream.input.bytes_received > 0) {
    const std::string whole = stream.stream_bytes ? " of " + cli::readable_bytes(*stream.stream_bytes) : "";
    row("received", cli::readable_bytes(stream.input.bytes_received) + whole);
  } else if (stream.stream_bytes) {
    row("size", cli::readable_bytes(*stream.stream_bytes));
  }
}

void playing_rows(const PlayerSnapshot& player, const InterfaceFacts& facts) {
  const LoaderSnapshot& stream = player.stream;
  row("decoding", fmt::format("{:.1f} ms, at most {:.1f}", stream.mean_decode_ms, stream.max_decode_ms));
  if (facts.shown_per_second > 1) {
    row("drawing", fmt::format("{:.1f} ms, {:.0f} frames/s", facts.draw_ms, facts.shown_per_second));
  }
  row("ahead", fmt::format("{} of {} frames", stream.frames_ahead, stream.ring_capacity));
  row("dropped", fmt::format("{} frames, {} stalls", player.dropped, player.stalls));
  if (!stream.damage.empty()) row("damage", fmt::format("{} places", stream.damage.size()));
}

void spinner(ImDrawList& list, ImVec2 middle, float radius) {
  constexpr int kDots = 10;
  const double turn = ImGui::GetTime() * kDots * 0.9;
  for (int i = 0; i < kDots; ++i) {
    const double angle = 2 * 3.14159265358979 * i / kDots;
    const double age = std::fmod(turn - i + 10 * kDots, kDots) / kDots;
    const auto alpha = static_cast<int>(40 + 215 * (1 - age));
    list.AddCircleFilled({middle.x + radius * static_cast<float>(std::cos(angle)),
                          middle.y + radius * static_cast<float>(std::sin(angle))},
                         radius * 0.17F, IM_COL32(255, 255, 255, alpha));
  }
}

}  // namespace

void draw_info(const PlayerSnapshot& player, const InterfaceFacts& facts) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  begin_panel("info", {size.x - kMargin, kMargin}, {1, 0});
  const auto name = player.stream.metadata.find("name");
  text(name != player.stream.metadata.end() && !name->second.empty() ? name->second : facts.name);
  if (ImGui::BeginTable("facts", 2)) {
    stream_rows(player);
    playing_rows(player, facts);
    ImGui::EndTable();
  }
  ImGui::End();
}

float draw_chart(const PlayerSnapshot& player, const InterfaceFacts& facts, float bottom) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float unit = ImGui::GetFontSize();
  const ImVec2 corner = {kMargin, bottom - 6 * unit};
  const ImVec2 end = {size.x - kMargin, bottom - 0.6F * unit};
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled(corner, end, theme::kPanel, 9);
  if (facts.packets.empty()) return corner.y;
  std::uint64_t most = 1;
  for (const FrameBytes& packet : facts.packets) most = std::max(most, packet.bytes);
  const std::string caption = fmt::format("bits per frame, up to {}", cli::readable_bytes(most));
  list.AddText({corner.x + 0.8F * unit, corner.y + 0.4F * unit}, theme::kFaintText, caption.c_str());
  const float floor = end.y - 0.5F * unit;
  const float tall = end.y - corner.y - 2.4F * unit;
  const float left = corner.x + 0.8F * unit;
  const std::uint64_t first = facts.packets.front().frame;
  const std::uint64_t count = std::max<std::uint64_t>(facts.packets.back().frame - first + 1, 120);
  const float step = (end.x - corner.x - 1.6F * unit) / static_cast<float>(count);
  for (const FrameBytes& packet : facts.packets) {
    const float x = left + step * static_cast<float>(packet.frame - first);
    const float height = std::max(1.0F, tall * static_cast<float>(packet.bytes) / static_cast<float>(most));
    const ImU32 colour = packet.frame == player.frame ? theme::kAccent : theme::kDecoded;
    list.AddRectFilled({x, floor - height}, {x + std::max(1.0F, step - 1), floor}, colour);
  }
  return corner.y;
}

void draw_help() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  begin_panel("help", {size.x / 2, size.y / 2 - 2 * ImGui::GetFontSize()}, {0.5F, 0.5F});
  if (ImGui::BeginTable("keys", 2)) {
    for (const KeyBinding& binding : key_bindings()) {
      if (binding.keys[0] != '\0') row(binding.keys, binding.text);
    }
    row("drag", "turn; with Shift or the right button: move; wheel: zoom");
    row("drop", "a file or a link on the window opens it");
    ImGui::EndTable();
  }
  ImGui::End();
}

void draw_state(const PlayerSnapshot& player) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const ImVec2 middle = {size.x / 2, size.y / 2};
  const float unit = ImGui::GetFontSize();
  using Status = PlayerSnapshot::Status;
  if (player.status == Status::kFailed) {
    begin_panel("failed", {middle.x, unit * 1.2F}, {0.5F, 0});
    ImGui::PushTextWrapPos(40 * unit);
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(theme::kDamage), "cannot go on");
    text(player.stream.message);
    ImGui::PopTextWrapPos();
    ImGui::End();
    return;
  }
  if (player.status != Status::kOpening && player.status != Status::kBuffering) return;
  begin_panel("waiting", middle, {0.5F, 0.5F});
  ImGui::Dummy({9 * unit, 4 * unit});
  const ImVec2 corner = ImGui::GetItemRectMin();
  spinner(*ImGui::GetWindowDrawList(), {corner.x + 4.5F * unit, corner.y + 2 * unit}, 1.4F * unit);
  const char* const what = player.status == Status::kOpening ? "opening" : "buffering";
  ImGui::SetCursorPosX((ImGui::GetWindowWidth() - ImGui::CalcTextSize(what).x) / 2);
  text(what);
  if (!player.stream.message.empty()) {
    ImGui::PushTextWrapPos(30 * unit);
    ImGui::TextDisabled("%s", player.stream.message.c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
}

void draw_welcome() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  begin_panel("welcome", {size.x / 2, size.y / 2}, {0.5F, 0.5F});
  text("Drop a .tvg file here, or paste its path or URL with Ctrl V.");
  ImGui::End();
}

void draw_notice(const std::string& notice) {
  const float width = ImGui::GetIO().DisplaySize.x;
  begin_panel("notice", {width / 2, kMargin}, {0.5F, 0});
  ImGui::PushTextWrapPos(width - 4 * kMargin);
  text(notice);
  ImGui::PopTextWrapPos();
  ImGui::End();
}

}  // namespace tvg::player
