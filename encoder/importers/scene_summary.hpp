#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tvg/source.hpp>

namespace tvg::cli {

/// What a scene holds.
struct SceneSummary {
  struct ClipSummary {
    std::string name;
    double duration = 0;               ///< seconds from the first key to the last
    std::uint64_t channels = 0;        ///< nodes it moves
    std::uint64_t morph_channels = 0;  ///< meshes whose morph targets it moves
    std::uint64_t frames = 0;          ///< at the rate asked for
  };
  struct MeshSummary {
    std::string name;
    std::vector<std::string> nodes;  ///< that hold it
    std::uint64_t vertices = 0;      ///< as the file has them
    std::uint64_t faces = 0;         ///< triangles, after polygons have been cut
    std::uint64_t bones = 0;
    std::uint64_t morph_targets = 0;
  };
  std::vector<ClipSummary> clips;
  std::vector<MeshSummary> meshes;
  std::optional<std::uint32_t> keyframes;  ///< of a file with a mesh per frame, which has no clips
  std::uint64_t welded_vertices = 0;       ///< of all meshes together; 0 where there is none with faces
  Skeleton skeleton;                       ///< the joints that move meshes; without a mesh, all that move
  Metadata metadata;                       ///< units and up axis, where the format says them
  std::vector<std::string> notes;          ///< what is lost or guessed, of clips in the first
};

/// Reads a scene or a BVH file; `fps` is the rate that frames are counted at. Throws ToolError: kUsage
/// (rate), kIo, kInvalidInput.
SceneSummary summarize_scene(const std::string& path, double fps);

}  // namespace tvg::cli
