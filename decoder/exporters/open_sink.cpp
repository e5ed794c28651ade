#include "decoder/exporters/cache_sink.hpp"
#include "decoder/exporters/frame_sink.hpp"
#include "decoder/exporters/gltf_sink.hpp"
#include "decoder/exporters/mesh_sequence_sink.hpp"
#include "tool/frame_pattern.hpp"
#include "tool/mesh_format.hpp"
#include "tool/tool_error.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

bool is_gltf(const std::string& path) {
  return has_suffix(path, ".glb") || has_suffix(path, ".gltf");
}

}  // namespace

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
  if (has_suffix(path, ".npy")) return std::make_unique<CacheSink>(path, CacheFormat::kNpy, options);
  if (is_gltf(path)) return std::make_unique<GltfSink>(path, options);
  if (const auto format = mesh_format(path)) {
    return std::make_unique<MeshSequenceSink>(path, *format, options);
  }
  throw ToolError(
      ExitStatus::kUsage,
      fmt::format(
          "{} has a suffix that cannot be written: caches are .pc2, .mdd or .npy, scenes .glb or "
          ".gltf; meshes, one per frame, are .obj, .ply, .off or .stl, in names such as back_%04d.obj",
          path));
}

std::vector<std::string> sink_outputs(const std::string& path, const SinkOptions& options) {
  std::vector<std::string> outputs = {path};
  if (path == "-") return outputs;
  if (const auto format = mesh_format(path)) {
    if (!parse_frame_pattern(path)) outputs.push_back(numbered_name(path));
    if (format == MeshFormat::kObj) outputs.push_back(materials_of_sequence(path));
  } else if (has_suffix(path, ".gltf")) {
    outputs.push_back(buffer_beside(path));
  } else if (options.mesh_beside_cache && !is_gltf(path)) {
    outputs.push_back(mesh_beside(path));
    outputs.push_back(materials_beside(mesh_beside(path)));
  }
  return outputs;
}

std::string written_files(const FrameSink& sink, const std::string& path) {
  const std::vector<std::string>& files = sink.files();
  const std::string names = files.empty()       ? path
                            : files.size() <= 2 ? fmt::format("{}", fmt::join(files, ", "))
                                                : files.front() + " to " + files.back();
  const std::vector<std::string> beside = sink.files_beside();
  if (beside.empty()) return names;
  return beside.size() <= 3
             ? fmt::format("{}, with {}", names, fmt::join(beside, ", "))
             : fmt::format("{}, with {} and {} images", names, beside.back(), beside.size() - 1);
}

}  // namespace tvg::cli
