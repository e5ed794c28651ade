#include "player/view/text_layer.hpp"

#include "player/view/find_font.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <array>
#include <backends/imgui_impl_opengl3.h>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <imgui.h>
#include <system_error>
#include <vector>

namespace tvg::player {

namespace {

constexpr ImU32 kInk = IM_COL32(38, 42, 52, 255);
constexpr ImU32 kFaintInk = IM_COL32(38, 42, 52, 170);
constexpr ImU32 kPlate = IM_COL32(255, 255, 255, 165);

ImU32 packed(const cli::Colour& colour) {
  const auto byte = [](float part) { return static_cast<int>(std::lround(255 * part)); };
  return IM_COL32(byte(colour.red), byte(colour.green), byte(colour.blue), 255);
}

float text_width(float size, const std::string& text) {
  return ImGui::GetFont()->CalcTextSizeA(size, 1e6F, 0, text.c_str()).x;
}

void put(ImDrawList& list, float size, float x, float y, ImU32 colour, const std::string& text) {
  // Letters are sharp where they start on whole pixels.
  list.AddText(ImGui::GetFont(), size, {std::round(x), std::round(y)}, colour, text.c_str());
}

void plate(ImDrawList& list, const TextPlace& place, float width, float height) {
  list.AddRectFilled({place.x, place.y}, {place.x + width, place.y + height}, kPlate, place.size * 0.35F);
}

/// The bar with its numbers, its upper left corner at (x, y).
void draw_scale(ImDrawList& list, float x, float y, float size, const Legend& legend) {
  constexpr int kPieces = 64;
  const float width = 0.9F * size;
  const float height = 8 * size;
  for (int i = 0; i < kPieces; ++i) {
    const float top = y + height * static_cast<float>(i) / kPieces;
    const float bottom = y + height * static_cast<float>(i + 1) / kPieces;
    const ImU32 above = packed(cli::map_colour(legend.map, 1 - static_cast<double>(i) / kPieces));
    const ImU32 below = packed(cli::map_colour(legend.map, 1 - static_cast<double>(i + 1) / kPieces));
    list.AddRectFilledMultiColor({x, top}, {x + width, bottom}, above, above, below, below);
  }
  constexpr int kTicks = 4;
  for (int i = 0; i <= kTicks; ++i) {
    const double value = legend.smallest + (legend.largest - legend.smallest) * (kTicks - i) / kTicks;
    const float at = y + height * static_cast<float>(i) / kTicks;
    list.AddLine({x + width, at}, {x + width + 0.3F * size, at}, kFaintInk);
    const std::string text =
        fmt::format("{:.3g}{}", value, i == 0 && !legend.units.empty() ? " " + legend.units : "");
    put(list, 0.85F * size, x + width + 0.5F * size, at - 0.47F * size, kInk, text);
  }
}

void draw_swatch(ImDrawList& list, float x, float y, float size, const cli::Colour& colour,
                 const std::string& text) {
  list.AddRectFilled({x, y + 0.1F * size}, {x + 0.9F * size, y + size}, packed(colour), 0.15F * size);
  put(list, 0.85F * size, x + 1.4F * size, y + 0.12F * size, kInk, text);
}

/// The font's bytes; nothing where they are none that ImGui can read, which would end the process over them.
std::vector<char> read_font(const std::string& path) {
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{64} << 20;
  std::error_code error;
  const std::uintmax_t size = path.empty() ? 0 : std::filesystem::file_size(path, error);
  if (error || size < 12 || size > kMostBytes) return {};
  std::vector<char> bytes(static_cast<std::size_t>(size));
  std::ifstream file(path, std::ios::binary);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(size))) return {};
  constexpr std::array<char, 4> kTrueType = {0, 1, 0, 0};
  constexpr std::array<char, 4> kApple = {'t', 'r', 'u', 'e'};
  const auto begins = [&](const std::array<char, 4>& mark) {
    return std::equal(mark.begin(), mark.end(), bytes.begin());
  };
  return begins(kTrueType) || begins(kApple) ? bytes : std::vector<char>();
}

}  // namespace

void load_font(float size) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  const std::vector<char> file = read_font(find_font());
  if (file.empty()) {
    fonts.AddFontDefault();
    return;
  }
  // ImGui frees what it is given with its own allocator.
  void* const owned = ImGui::MemAlloc(file.size());
  std::memcpy(owned, file.data(), file.size());
  fonts.AddFontFromMemoryTTF(owned, static_cast<int>(file.size()), size);
}

float text_size(int picture_height) {
  return std::round(std::clamp(static_cast<float>(picture_height) / 42, 11.0F, 40.0F));
}

void draw_label(ImDrawList& list, const TextPlace& place, const std::string& text) {
  plate(list, place, text_width(place.size, text) + place.size, 1.5F * place.size);
  put(list, place.size, place.x + 0.5F * place.size, place.y + 0.22F * place.size, kInk, text);
}

TextExtent legend_extent(const Legend& legend, float size) {
  const bool flags = legend.map == cli::ColourMap::kFlags;
  const auto beside_colour = [size](const std::string& text) {
    return 1.4F * size + text_width(0.85F * size, text);
  };
  float width = std::max(text_width(size, legend.title), text_width(0.8F * size, legend.note));
  width = std::max(width, beside_colour(flags ? legend.flagged : "0.00012 " + legend.units));
  if (flags) width = std::max(width, beside_colour(legend.plain));
  const float noted = legend.note.empty() ? 0 : 1.1F * size;
  return {width + 1.4F * size, (flags ? 4.9F : 11.4F) * size + noted};
}

void draw_legend(ImDrawList& list, const TextPlace& place, const Legend& legend) {
  const float size = place.size;
  const TextExtent extent = legend_extent(legend, size);
  plate(list, place, extent.width, extent.height);
  const float x = place.x + 0.7F * size;
  float y = place.y + 0.45F * size;
  put(list, size, x, y, kInk, legend.title);
  y += 1.3F * size;
  if (!legend.note.empty()) put(list, 0.8F * size, x, y, kFaintInk, legend.note);
  y += (legend.note.empty() ? 0.4F : 1.8F) * size;
  if (legend.map == cli::ColourMap::kFlags) {
    draw_swatch(list, x, y, size, cli::map_colour(legend.map, 1), legend.flagged);
    draw_swatch(list, x, y + 1.4F * size, size, cli::map_colour(legend.map, 0), legend.plain);
  } else {
    draw_scale(list, x, y, size, legend);
  }
}

TextLayer::TextLayer(float largest_size) : context_(ImGui::CreateContext()) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  load_font(largest_size);
  if (!ImGui_ImplOpenGL3_Init("#version 330 core")) {
    ImGui::DestroyContext(context_);
    throw cli::ToolError(cli::ExitStatus::kOther,
                         "cannot draw text: OpenGL's functions are not found (libGL.so.1)");
  }
}

TextLayer::~TextLayer() {
  ImGui::SetCurrentContext(context_);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(context_);
}

ImDrawList& TextLayer::begin(int width, int height) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  io.DeltaTime = 1.0F / 60;
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  return *ImGui::GetBackgroundDrawList();
}

void TextLayer::end() {
  ImGui::SetCurrentContext(context_);
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace tvg::player
