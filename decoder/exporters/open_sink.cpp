#include "decoder/exporters/cache_sink.hpp"
#include "decoder/exporters/frame_sink.hpp"
#include "decoder/exporters/mesh_sequence_sink.hpp"
#include "tool/frame_pattern.hpp"
#include "tool/mesh_format.hpp"
#include "tool/tool_error.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace tvg::cli {

std::unique_ptr<FrameSink> open_sink(const std::string& path, const SinkOptions& options) {
  std::error_code ignored;
  if (path != "-" && std::filesystem::is_directory(path, ignored)) {
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("{} is a folder: give a name in it, such as {}/frame_%04d.obj", path,
                                path.substr(0, path.find_last_not_of('/') + 1)));
  }
  if (path == "-" || has_suffix(path, ".pc2")) {
    return std::make_unique<CacheSink>(path, CacheFormat::kPc2, options);
  }
  if (has_suffix(path, ".mdd")) return std::make_unique<CacheSink>(path, CacheFormat::kMdd, options);
  if (const auto format = mesh_format(path)) {
    return std::make_unique<MeshSequenceSink>(path, *format, options);
  }
  throw ToolError(
      ExitStatus::kUsage,
      fmt::format("{} has a suffix that cannot be written: caches are .pc2 or .mdd; meshes, one per frame, "
                  "are .obj, .ply, .off or .stl, in names such as back_%04d.obj",
                  path));
}

std::vector<std::string> sink_outputs(const std::string& path, const SinkOptions& options) {
  std::vector<std::string> outputs = {path};
  if (path == "-") return outputs;
  if (mesh_format(path)) {
    if (!parse_frame_pattern(path)) outputs.push_back(numbered_name(path));
  } else if (options.mesh_beside_cache) {
    outputs.push_back(mesh_beside(path));
  }
  return outputs;
}

}  // namespace tvg::cli
