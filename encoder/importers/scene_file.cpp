#include "encoder/importers/scene_file.hpp"

#include "tool/mesh_format.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

namespace tvg::cli {

namespace {

constexpr std::array<std::string_view, 17> kSuffixes = {
    ".gltf", ".glb", ".fbx", ".dae", ".x",    ".md5mesh", ".md2", ".md3",     ".mdc",
    ".mdl",  ".smd", ".b3d", ".3ds", ".ms3d", ".ase",     ".lws", ".mesh.xml"};

/// Of files that scenes name: buffers of glTF, motion of MD5 and SMD, skeletons of Ogre, objects of LWS.
constexpr std::array<std::string_view, 7> kSuffixesBeside = {".bin",          ".md5anim", ".smd", ".vta",
                                                             ".skeleton.xml", ".mtl",     ".lwo"};

}  // namespace

const char* const kSceneFormats =
    "scenes are glTF 2 (.gltf, .glb), .fbx, COLLADA (.dae), .x, .md5mesh, .md2, .md3, .mdc, .mdl, .smd, "
    ".b3d, .3ds, .ms3d, .ase, .lws or .mesh.xml";

bool is_scene(const std::string& path) {
  return std::any_of(kSuffixes.begin(), kSuffixes.end(),
                     [&path](std::string_view suffix) { return has_suffix(path, suffix); });
}

std::vector<std::string> with_scene_files(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    files.push_back(path);
    if (!is_scene(path)) continue;
    const std::string folder = path.substr(0, path.rfind('/') + 1);
    std::error_code error;
    std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, error);
    for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      const bool beside = std::any_of(kSuffixesBeside.begin(), kSuffixesBeside.end(),
                                      [&name](std::string_view suffix) { return has_suffix(name, suffix); });
      if (beside) files.push_back(folder + name);
    }
  }
  return files;
}

}  // namespace tvg::cli
