#include "tool/mesh_format.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <system_error>

namespace tvg::cli {

namespace {

constexpr std::array<const char*, 5> kCacheSuffixes = {".pc2", ".pc16", ".mdd", ".npy", ".npz"};

}  // namespace

bool has_suffix(const std::string& path, std::string_view suffix) {
  if (path.size() < suffix.size()) return false;
  return std::equal(suffix.begin(), suffix.end(), path.end() - static_cast<std::ptrdiff_t>(suffix.size()),
                    [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

bool is_cache_file(const std::string& path) {
  return std::any_of(kCacheSuffixes.begin(), kCacheSuffixes.end(),
                     [&](const char* suffix) { return has_suffix(path, suffix); });
}

std::vector<std::string> caches_beside(const std::string& mesh) {
  std::vector<std::string> found;
  for (const char* suffix : kCacheSuffixes) {
    std::string candidate = std::filesystem::path(mesh).replace_extension(suffix).string();
    std::error_code ignored;
    if (std::filesystem::is_regular_file(candidate, ignored)) found.push_back(std::move(candidate));
  }
  return found;
}

std::optional<MeshFormat> mesh_format(const std::string& path) {
  if (has_suffix(path, ".obj")) return MeshFormat::kObj;
  if (has_suffix(path, ".ply")) return MeshFormat::kPly;
  if (has_suffix(path, ".off")) return MeshFormat::kOff;
  if (has_suffix(path, ".stl")) return MeshFormat::kStl;
  return std::nullopt;
}

}  // namespace tvg::cli
