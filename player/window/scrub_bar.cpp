#include "player/window/scrub_bar.hpp"

#include "player/window/theme.hpp"

#include <algorithm>
#include <cmath>

namespace tvg::player {

namespace {

/// Frames to pixels and back.
struct Ruler {
  float left = 0;
  float width = 1;
  std::uint64_t frames = 1;

  float at(std::uint64_t frame) const {
    const double share = static_cast<double>(std::min(frame, frames)) / static_cast<double>(frames);
    return left + width * static_cast<float>(share);
  }
  std::uint64_t frame_at(float x) const {
    const double share = std::clamp(static_cast<double>((x - left) / width), 0.0, 1.0);
    return std::min(frames - 1, static_cast<std::uint64_t>(share * static_cast<double>(frames)));
  }
};

void draw_runs(ImDrawList& list, const Ruler& ruler, const std::vector<FrameRun>& runs, float top,
               float bottom, ImU32 colour) {
  for (const FrameRun& run : runs) {
    list.AddRectFilled({ruler.at(run.first), top}, {ruler.at(run.first + run.count), bottom}, colour, 2);
  }
}

void draw_gop_marks(ImDrawList& list, const Ruler& ruler, const std::vector<GopMark>& marks, float top,
                    float bottom) {
  constexpr float kNarrowest = 4;  // pixels: marks closer than this would only make the bar dark
  float last = ruler.left;
  for (const GopMark& mark : marks) {
    const float x = ruler.at(mark.first_frame);
    if (x - last < kNarrowest) continue;
    list.AddLine({x, top}, {x, bottom}, theme::kGopMark);
    last = x;
  }
}

void draw_damage(ImDrawList& list, const Ruler& ruler, const std::vector<DamageMark>& marks, float top,
                 float bottom) {
  for (const DamageMark& mark : marks) {
    const float left = ruler.at(mark.frames.first);
    const float right = std::max(left + 3, ruler.at(mark.frames.first + mark.frames.count));
    list.AddRectFilled({left, top - 2}, {right, bottom + 2}, theme::kDamage, 2);
  }
}

void draw_tooltip(const LoaderSnapshot& stream, std::uint64_t frame, double rate) {
  ImGui::BeginTooltip();
  ImGui::Text("frame %llu   %.2f s", static_cast<unsigned long long>(frame),
              static_cast<double>(frame) / rate);
  for (const DamageMark& mark : stream.damage) {
    const bool here = frame >= mark.frames.first && frame < mark.frames.first + mark.frames.count;
    if (here)
      ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(theme::kDamage), "lost: %s", mark.message.c_str());
  }
  ImGui::EndTooltip();
}

}  // namespace

std::optional<std::uint64_t> draw_scrub_bar(const PlayerSnapshot& player, float width) {
  const LoaderSnapshot& stream = player.stream;
  const float height = ImGui::GetFrameHeight();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("scrub", {width, height});
  const bool hovered = ImGui::IsItemHovered();
  const bool dragged = ImGui::IsItemActive();

  ImDrawList& list = *ImGui::GetWindowDrawList();
  const std::uint64_t frames = std::max({stream.frame_count.value_or(stream.known_frames), player.frame + 1});
  const Ruler ruler{corner.x, width, frames};
  const float middle = corner.y + height / 2;
  const float half = height * (hovered || dragged ? 0.20F : 0.15F);
  const float top = middle - half;
  const float bottom = middle + half;
  list.AddRectFilled({corner.x, top}, {corner.x + width, bottom}, theme::kTrack, 3);
  draw_runs(list, ruler, stream.buffered, top, bottom, theme::kBuffered);
  const float now = ruler.at(player.frame);
  list.AddRectFilled({corner.x, top}, {now, bottom}, theme::kAccent, 3);
  draw_runs(list, ruler, stream.decoded, bottom + 1, bottom + 3, theme::kDecoded);
  draw_gop_marks(list, ruler, *stream.gops, top, bottom);
  draw_damage(list, ruler, stream.damage, top, bottom);
  if (player.range) {
    const std::uint64_t last = player.range->last.value_or(frames - 1);
    list.AddRect({ruler.at(player.range->first), top - 4}, {ruler.at(last + 1), bottom + 4}, theme::kText, 3);
  }
  list.AddCircleFilled({now, middle}, half + (hovered || dragged ? 5.0F : 3.5F), theme::kText, 24);

  const std::uint64_t pointed = ruler.frame_at(ImGui::GetIO().MousePos.x);
  if (hovered || dragged) draw_tooltip(stream, pointed, player.rate);
  if (dragged && pointed != player.frame) return pointed;
  return std::nullopt;
}

}  // namespace tvg::player
