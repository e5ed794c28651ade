#include "cli/player_folder.hpp"

#include "tool/player_page.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <system_error>
#include <vector>

namespace tvg::cli {

namespace fs = std::filesystem;

fs::path find_player_folder(const std::string& named) {
  std::vector<fs::path> places;
  std::error_code error;
  if (!named.empty()) {
    places.emplace_back(named);
  } else {
    const fs::path tool = fs::read_symlink("/proc/self/exe", error);
    if (!error) places.push_back(tool.parent_path().parent_path() / "share" / "tvg" / "web");
    places.emplace_back(TVG_PAGE_FOLDER);
  }
  for (const fs::path& place : places) {
    const auto is_there = [&](const char* name) { return fs::is_regular_file(place / name, error); };
    if (std::all_of(kPlayerFiles.begin(), kPlayerFiles.end(), is_there)) return place;
  }
  return {};
}

fs::path player_folder(const std::string& named) {
  fs::path folder = find_player_folder(named);
  if (!folder.empty()) return folder;
  throw ToolError(ExitStatus::kIo,
                  fmt::format("{}: there is no player, which is {}; its files are built with npm ci in web/ "
                              "and the preset wasm (docs/web.md), and --player names the folder they lie in",
                              named.empty() ? TVG_PAGE_FOLDER : named, fmt::join(kPlayerFiles, ", ")));
}

}  // namespace tvg::cli
