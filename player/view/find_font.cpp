#include "player/view/find_font.hpp"

#include <filesystem>
#include <fontconfig/fontconfig.h>
#include <initializer_list>
#include <memory>
#include <system_error>

namespace tvg::player {

namespace {

bool is_file(const std::string& path) {
  std::error_code none;
  return std::filesystem::is_regular_file(path, none);
}

/// What fontconfig finds for DejaVu Sans; empty where it has no outline font at all.
std::string ask_fontconfig() {
  const std::unique_ptr<FcConfig, void (*)(FcConfig*)> config(FcInitLoadConfigAndFonts(), FcConfigDestroy);
  if (config == nullptr) return "";
  const std::unique_ptr<FcPattern, void (*)(FcPattern*)> wanted(FcPatternCreate(), FcPatternDestroy);
  if (wanted == nullptr) return "";
  const auto text = [](const char* name) { return reinterpret_cast<const FcChar8*>(name); };
  FcPatternAddString(wanted.get(), FC_FAMILY, text("DejaVu Sans"));
  FcPatternAddString(wanted.get(), FC_FAMILY, text("sans-serif"));
  FcPatternAddString(wanted.get(), FC_STYLE, text("Book"));
  FcPatternAddString(wanted.get(), FC_FONTFORMAT, text("TrueType"));  // as ImGui reads them
  FcConfigSubstitute(config.get(), wanted.get(), FcMatchPattern);
  FcDefaultSubstitute(wanted.get());
  FcResult result = FcResultNoMatch;
  const std::unique_ptr<FcPattern, void (*)(FcPattern*)> found(
      FcFontMatch(config.get(), wanted.get(), &result), FcPatternDestroy);
  FcChar8* file = nullptr;
  if (found == nullptr || FcPatternGetString(found.get(), FC_FILE, 0, &file) != FcResultMatch) return "";
  return reinterpret_cast<const char*>(file);
}

}  // namespace

std::string find_font() {
  std::string found = ask_fontconfig();
  if (is_file(found)) return found;
  for (const char* path :
       {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
        "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf"}) {
    if (is_file(path)) return path;
  }
  return "";
}

}  // namespace tvg::player
