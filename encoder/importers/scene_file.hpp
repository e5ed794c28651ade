#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tvg/source.hpp>

struct aiScene;

namespace tvg::cli {

/// The suffixes of scenes, for messages.
extern const char* const kSceneFormats;

/// Whether the suffix of `path` names a format that may hold clips, bones or vertex animation.
bool is_scene(const std::string& path);

/// `paths`, and after each scene the files beside it that its format may name: buffers, skeletons, motion.
std::vector<std::string> with_scene_files(const std::vector<std::string>& paths);

/// A scene in memory, its polygons triangulated. Throws ImportError that names the file: kIo where there is
/// no such file, kInvalidInput for content that assimp refuses.
class SceneFile {
 public:
  /// `keyframe` picks a frame of a format that holds one mesh per frame (MD2).
  explicit SceneFile(const std::string& path, std::optional<std::uint32_t> keyframe = {});
  ~SceneFile();
  SceneFile(const SceneFile&) = delete;
  SceneFile& operator=(const SceneFile&) = delete;

  const std::string& path() const { return path_; }
  const aiScene& scene() const { return *scene_; }
  /// Units and up axis, where the format says them.
  Metadata metadata() const;
  /// Ends with ImportError (kInvalidInput) that names the file.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string path_;
  struct Import;
  std::unique_ptr<Import> import_;
  const aiScene* scene_ = nullptr;
};

}  // namespace tvg::cli
