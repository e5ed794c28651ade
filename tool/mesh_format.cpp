#include "tool/mesh_format.hpp"

#include <algorithm>
#include <cctype>

namespace tvg::cli {

bool has_suffix(const std::string& path, std::string_view suffix) {
  if (path.size() < suffix.size()) return false;
  return std::equal(suffix.begin(), suffix.end(), path.end() - static_cast<std::ptrdiff_t>(suffix.size()),
                    [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

bool is_cache_file(const std::string& path) {
  return has_suffix(path, ".pc2") || has_suffix(path, ".mdd");
}

std::optional<MeshFormat> mesh_format(const std::string& path) {
  if (has_suffix(path, ".obj")) return MeshFormat::kObj;
  if (has_suffix(path, ".ply")) return MeshFormat::kPly;
  if (has_suffix(path, ".off")) return MeshFormat::kOff;
  if (has_suffix(path, ".stl")) return MeshFormat::kStl;
  return std::nullopt;
}

}  // namespace tvg::cli
