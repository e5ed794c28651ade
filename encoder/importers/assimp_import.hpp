#pragma once
#include <cstdint>
#include <memory>
#include <optional>

struct aiScene;
namespace Assimp {
class Importer;
}

namespace tvg::cli {

struct Scene;

/// A file that assimp has read; if a polygon in it is no fan around a corner, all have been cut to triangles.
/// A child process reads it first, so that a crash,
/// an endless loop or a size that is a lie becomes a message.
class AssimpImport {
 public:
  /// Reads the file of `scene`, of which only the path is there yet. Throws ImportError (kInvalidInput).
  AssimpImport(const Scene& scene, std::optional<std::uint32_t> keyframe);
  ~AssimpImport();
  AssimpImport(const AssimpImport&) = delete;
  AssimpImport& operator=(const AssimpImport&) = delete;

  const aiScene& operator*() const { return *scene_; }
  const aiScene* operator->() const { return scene_; }

 private:
  std::unique_ptr<Assimp::Importer> importer_;
  const aiScene* scene_ = nullptr;
};

}  // namespace tvg::cli
