#pragma once
#include <imgui.h>

// The look of the window's controls: dark glass over a light scene.
namespace tvg::player::theme {

inline constexpr ImU32 kText = IM_COL32(240, 242, 246, 255);
inline constexpr ImU32 kFaintText = IM_COL32(168, 176, 190, 255);
inline constexpr ImU32 kAccent = IM_COL32(255, 158, 74, 255);
inline constexpr ImU32 kTrack = IM_COL32(255, 255, 255, 34);
inline constexpr ImU32 kBuffered = IM_COL32(255, 255, 255, 80);
inline constexpr ImU32 kDecoded = IM_COL32(130, 190, 255, 200);
inline constexpr ImU32 kGopMark = IM_COL32(0, 0, 0, 120);
inline constexpr ImU32 kDamage = IM_COL32(240, 72, 72, 255);
inline constexpr ImU32 kPanel = IM_COL32(22, 25, 32, 218);

/// Sets colours, roundings and font of the present ImGui. `scale`: pixels of the display to pixels of a
/// usual one.
void apply(float scale);

}  // namespace tvg::player::theme
