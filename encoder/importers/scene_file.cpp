#include "encoder/importers/scene_file.hpp"

#include "encoder/importers/glb_header.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/input_file.hpp"
#include "encoder/importers/trial.hpp"
#include "tool/mesh_format.hpp"
#include "tool/option_values.hpp"

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <string_view>

namespace tvg::cli {

namespace {

constexpr std::array<std::string_view, 17> kSuffixes = {
    ".gltf", ".glb", ".fbx", ".dae", ".x",    ".md5mesh", ".md2", ".md3",     ".mdc",
    ".mdl",  ".smd", ".b3d", ".3ds", ".ms3d", ".ase",     ".lws", ".mesh.xml"};

/// Of files that scenes name: buffers of glTF, motion of MD5 and SMD, skeletons of Ogre, objects of LWS.
constexpr std::array<std::string_view, 7> kSuffixesBeside = {".bin",          ".md5anim", ".smd", ".vta",
                                                             ".skeleton.xml", ".mtl",     ".lwo"};

/// Memory that assimp has for a file: the least, and how many times the bytes of the file and of those that
/// it may name.
constexpr std::uint64_t kLeastMemory = std::uint64_t{1} << 30;
constexpr std::uint64_t kMemoryPerByte = 64;

/// What assimp has for a file; the largest characters take a few seconds.
TrialLimits limits_for(const std::string& path) {
  TrialLimits limits;
  std::uint64_t bytes = 0;
  for (const std::string& file : with_scene_files({path})) {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(file, error);
    if (!error) bytes += size;
  }
  limits.memory_bytes = kLeastMemory + kMemoryPerByte * bytes;
  return limits;
}

/// FBX says centimetres per unit.
std::string unit_of_centimetres(double centimetres) {
  struct Unit {
    double centimetres;
    const char* name;
  };
  for (const Unit& unit : {Unit{0.1, "mm"}, Unit{1, "cm"}, Unit{100, "m"}, Unit{100000, "km"},
                           Unit{2.54, "in"}, Unit{30.48, "ft"}}) {
    if (std::abs(centimetres - unit.centimetres) <= 1e-6 * unit.centimetres) return unit.name;
  }
  return "";
}

Metadata fbx_metadata(const aiScene& scene) {
  Metadata metadata;
  if (scene.mMetaData == nullptr) return metadata;
  double scale = 0;
  float single_scale = 0;
  if (!scene.mMetaData->Get("UnitScaleFactor", scale) &&
      scene.mMetaData->Get("UnitScaleFactor", single_scale)) {
    scale = double{single_scale};
  }
  if (const std::string unit = unit_of_centimetres(scale); !unit.empty()) metadata.emplace("units", unit);
  std::int32_t up = -1;
  if (scene.mMetaData->Get("UpAxis", up) && (up == 1 || up == 2)) metadata.emplace("up", up == 1 ? "y" : "z");
  return metadata;
}

const aiScene* import(Assimp::Importer& importer, const std::string& path,
                      std::optional<std::uint32_t> keyframe) {
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_MD3_HANDLE_MULTIPART, false);
  if (keyframe) importer.SetPropertyInteger(AI_CONFIG_IMPORT_GLOBAL_KEYFRAME, static_cast<int>(*keyframe));
  return importer.ReadFile(path, aiProcess_Triangulate);
}

/// assimp crashes, hangs or takes all memory on some damaged files (a cut .md5mesh, for one), so a child
/// process goes first.
void try_import(const SceneFile& file, std::optional<std::uint32_t> keyframe) {
  const auto action = [&file, keyframe] {
    Assimp::Importer importer;
    import(importer, file.path(), keyframe);
  };
  const TrialLimits limits = limits_for(file.path());
  switch (run_trial(action, limits)) {
    case TrialResult::kFine:
      return;
    case TrialResult::kCrashed:
      file.fail("it is damaged or no such file as its suffix says: assimp, which reads it, crashes on it");
    case TrialResult::kTooLong:
      file.fail(fmt::format("it is damaged or too large: assimp, which reads it, does not end within {} s",
                            limits.cpu_seconds));
    case TrialResult::kTooMuchMemory:
      file.fail(
          fmt::format("it is damaged or too large: assimp, which reads it, asks for more than {} of "
                      "memory, or than there is",
                      readable_bytes(limits.memory_bytes)));
  }
}

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

struct SceneFile::Import {
  Assimp::Importer importer;
};

SceneFile::SceneFile(const std::string& path, std::optional<std::uint32_t> keyframe)
    : path_(path), import_(std::make_unique<Import>()) {
  // A file that is not there, or may not be read, is told in the system's own words.
  require_regular_file(path);
  InputFile readable(path);
  if (has_suffix(path, ".glb")) check_glb_sizes(path);
  // Frames after the first come from a file that has been tried.
  if (keyframe.value_or(0) == 0) try_import(*this, keyframe);
  std::string reason;
  try {
    scene_ = import(import_->importer, path, keyframe);
    reason = import_->importer.GetErrorString();
  } catch (const std::exception& error) {
    reason = error.what();
  }
  if (scene_ == nullptr || scene_->mRootNode == nullptr) {
    fail(fmt::format("it cannot be read as what its suffix says: {}",
                     reason.empty() ? "it holds no scene" : reason));
  }
}

SceneFile::~SceneFile() = default;

Metadata SceneFile::metadata() const {
  if (has_suffix(path_, ".fbx")) return fbx_metadata(*scene_);
  // glTF prescribes both; assimp turns and scales COLLADA to the same.
  if (has_suffix(path_, ".gltf") || has_suffix(path_, ".glb") || has_suffix(path_, ".dae")) {
    return {{"units", "m"}, {"up", "y"}};
  }
  return {};
}

void SceneFile::fail(const std::string& what) const {
  throw ImportError(ErrorCode::kInvalidInput, fmt::format("{}: {}", path_, what));
}

}  // namespace tvg::cli
