#include "encoder/importers/assimp_import.hpp"

#include "encoder/importers/assimp_polygons.hpp"
#include "encoder/importers/scene_file.hpp"
#include "encoder/importers/scene_reader.hpp"
#include "encoder/importers/trial.hpp"
#include "tool/option_values.hpp"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <filesystem>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

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

const aiScene* import(Assimp::Importer& importer, const std::string& path,
                      std::optional<std::uint32_t> keyframe) {
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_MD3_HANDLE_MULTIPART, false);
  if (keyframe) importer.SetPropertyInteger(AI_CONFIG_IMPORT_GLOBAL_KEYFRAME, static_cast<int>(*keyframe));
  const aiScene* const scene = importer.ReadFile(path, 0);
  // Polygons are kept where they can be; others assimp cuts as they need to be.
  if (scene == nullptr || are_fans(*scene)) return scene;
  return importer.ApplyPostProcessing(aiProcess_Triangulate);
}

/// assimp crashes, hangs or takes all memory on some damaged files (a cut .md5mesh, for one), so a child
/// process goes first.
void try_import(const Scene& scene, std::optional<std::uint32_t> keyframe) {
  const auto action = [&scene, keyframe] {
    Assimp::Importer importer;
    import(importer, scene.path, keyframe);
  };
  const TrialLimits limits = limits_for(scene.path);
  switch (run_trial(action, limits)) {
    case TrialResult::kFine:
      return;
    case TrialResult::kCrashed:
      scene.fail("it is damaged or no such file as its suffix says: assimp, which reads it, crashes on it");
    case TrialResult::kTooLong:
      scene.fail(fmt::format("it is damaged or too large: assimp, which reads it, does not end within {} s",
                             limits.cpu_seconds));
    case TrialResult::kTooMuchMemory:
      scene.fail(
          fmt::format("it is damaged or too large: assimp, which reads it, asks for more than {} of "
                      "memory, or than there is",
                      readable_bytes(limits.memory_bytes)));
  }
}

}  // namespace

AssimpImport::AssimpImport(const Scene& scene, std::optional<std::uint32_t> keyframe)
    : importer_(std::make_unique<Assimp::Importer>()) {
  // Frames after the first come from a file that has been tried.
  if (keyframe.value_or(0) == 0) try_import(scene, keyframe);
  std::string reason;
  try {
    scene_ = import(*importer_, scene.path, keyframe);
    reason = importer_->GetErrorString();
  } catch (const std::exception& error) {
    reason = error.what();
  }
  if (scene_ == nullptr || scene_->mRootNode == nullptr) {
    scene.fail(fmt::format("it cannot be read as what its suffix says: {}",
                           reason.empty() ? "it holds no scene" : reason));
  }
}

AssimpImport::~AssimpImport() = default;

}  // namespace tvg::cli
