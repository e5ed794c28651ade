#include "encoder/importers/open_source.hpp"

#include "encoder/importers/cache_source.hpp"
#include "encoder/importers/frame_range.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/mesh_sequence.hpp"
#include "encoder/importers/scene_file.hpp"
#include "encoder/importers/scene_source.hpp"
#include "encoder/importers/skeleton_source.hpp"
#include "tool/frame_pattern.hpp"
#include "tool/mesh_format.hpp"
#include "tool/option_values.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kKnownFormats =
    "meshes are .obj, .ply, .off or .stl, caches are .pc2 or .mdd, sequences are folders or patterns such as "
    "walk_%04d.obj";

bool is_cache(const std::string& path) {
  return path == "-" || is_cache_file(path);
}

[[noreturn]] void fail_usage(const std::string& message) {
  throw ToolError(ExitStatus::kUsage, message);
}

void check_known(const std::string& path) {
  std::error_code ignored;
  if (is_cache(path) || is_scene(path) || fs::is_directory(path, ignored)) return;
  if (has_suffix(path, ".tvg")) {
    throw ImportError(ErrorCode::kInvalidInput,
                      fmt::format("{} is a TVG stream already; `tvg decode` turns it into meshes", path));
  }
  if (mesh_format(path)) return;
  if (!fs::exists(path, ignored) && !parse_frame_pattern(path)) {
    throw ImportError(ErrorCode::kIo, fmt::format("cannot open {}: there is no such file", path));
  }
  throw ImportError(ErrorCode::kInvalidInput, fmt::format("{} has a suffix that is not known: {}; {}", path,
                                                          kKnownFormats, kSceneFormats));
}

/// The mesh that probably goes with a cache: the one beside it with the same name.
std::string mesh_beside(const std::string& cache) {
  for (const char* suffix : {".obj", ".ply", ".off", ".stl"}) {
    std::string candidate = fs::path(cache).replace_extension(suffix).string();
    std::error_code ignored;
    if (fs::is_regular_file(candidate, ignored)) return candidate;
  }
  return "";
}

[[noreturn]] void fail_cache_alone(const std::string& cache) {
  const std::string name = cache == "-" ? "standard input" : cache;
  const std::string beside = cache == "-" ? "" : mesh_beside(cache);
  if (!beside.empty()) {
    fail_usage(fmt::format("{} is a cache of positions and has no faces: add its mesh, which may be {}", name,
                           beside));
  }
  const std::string example =
      cache == "-" ? "mesh.obj" : fs::path(cache).filename().replace_extension(".obj").string();
  fail_usage(fmt::format("{} is a cache of positions and has no faces: add its mesh, a file such as {}", name,
                         example));
}

/// Puts the skeleton of `spec`, where there is one, beside a source whose first frame is `first` of `total`.
std::unique_ptr<FrameSource> with_skeleton(std::unique_ptr<FrameSource> source, const SourceSpec& spec,
                                           std::uint64_t first, std::uint64_t total,
                                           std::vector<std::string>& notes) {
  if (spec.skeleton.empty()) return source;
  return attach_skeleton(std::move(source), {spec.skeleton, spec.scene.fps, first, total}, notes);
}

OpenedSource open_mesh_and_cache(const std::string& mesh_path, const std::string& cache,
                                 const SourceSpec& spec) {
  std::error_code ignored;
  if (fs::is_directory(mesh_path, ignored) ||
      (parse_frame_pattern(mesh_path) && !fs::exists(mesh_path, ignored))) {
    fail_usage(fmt::format("{} goes with one mesh file, and {} is a sequence", cache, mesh_path));
  }
  WeldedMesh welded = read_welded_mesh(mesh_path);
  Metadata metadata;
  if (!welded.mesh.name.empty()) metadata.emplace("name", welded.mesh.name);
  Mesh mesh{static_cast<std::uint32_t>(welded.mesh.vertex_count()), std::move(welded.mesh.faces)};
  auto source = open_cache(cache, std::move(mesh), std::move(metadata), mesh_path, spec.open_ended);
  const std::optional<std::uint64_t> known = source->frame_count();
  if (!known && !spec.skeleton.empty())
    fail_usage("--skeleton needs to know the number of frames: not from a pipe");
  const std::uint64_t frame_count = known.value_or(std::numeric_limits<std::uint64_t>::max());
  source = with_skeleton(std::move(source), spec, 0, frame_count, welded.notes);
  if (!spec.frames) return {std::move(source), std::move(welded.notes)};
  check_frame_range(*spec.frames, frame_count, cache == "-" ? "standard input" : cache);
  return {std::make_unique<FrameRangeSource>(std::move(source), *spec.frames), std::move(welded.notes)};
}

OpenedSource open_meshes(const std::string& input, const SourceSpec& spec) {
  const std::optional<FrameRange>& frames = spec.frames;
  std::vector<std::string> files;
  std::error_code ignored;
  if (fs::is_directory(input, ignored)) {
    files = find_folder_files(input);
  } else if (auto numbered = find_pattern_files(input)) {
    files = std::move(*numbered);
  } else {
    files = {input};
  }
  const std::uint64_t frame_count = files.size();
  if (frames) {
    check_frame_range(*frames, frame_count, input);
    // The range picks files before the first is read: connectivity may differ outside it.
    files.erase(files.begin() + static_cast<std::ptrdiff_t>(frames->last) + 1, files.end());
    files.erase(files.begin(), files.begin() + static_cast<std::ptrdiff_t>(frames->first));
  }
  WeldedMesh first = read_welded_mesh(files[0]);
  std::vector<std::string> notes = std::move(first.notes);
  const std::uint64_t first_frame = frames ? frames->first : 0;
  std::unique_ptr<FrameSource> source =
      std::make_unique<MeshSequenceSource>(std::move(files), std::move(first), first_frame);
  source = with_skeleton(std::move(source), spec, first_frame, frame_count, notes);
  return {std::move(source), std::move(notes)};
}

OpenedSource open_scene_alone(const SourceSpec& spec, const std::string& path) {
  if (spec.inputs.size() > 1) {
    fail_usage(fmt::format("{} is a scene, which brings its own motion: it is the only input", path));
  }
  if (!spec.skeleton.empty()) {
    fail_usage(
        fmt::format("--skeleton {}: {} is a scene, which brings its own skeleton", spec.skeleton, path));
  }
  OpenedScene opened = open_scene(path, spec.scene);
  if (!spec.frames) return {std::move(opened.source), std::move(opened.notes)};
  check_frame_range(*spec.frames, opened.source->frame_count().value(), path);
  return {std::make_unique<FrameRangeSource>(std::move(opened.source), *spec.frames),
          std::move(opened.notes)};
}

void refuse_scene_options(const SceneOptions& options) {
  const char* option = !options.clip.empty() ? "--clip" : !options.meshes.empty() ? "--mesh" : nullptr;
  if (option != nullptr)
    fail_usage(fmt::format("{} is for scenes, and the input is none: {}", option, kSceneFormats));
}

}  // namespace

OpenedSource open_source(const SourceSpec& spec) {
  for (const std::string& input : spec.inputs) {
    std::error_code ignored;
    if (is_scene(input) && !fs::is_directory(input, ignored)) return open_scene_alone(spec, input);
  }
  refuse_scene_options(spec.scene);
  std::string mesh;
  std::string cache;
  for (const std::string& input : spec.inputs) {
    check_known(input);
    std::string& place = is_cache(input) ? cache : mesh;
    if (!place.empty()) {
      if (is_cache(input))
        fail_usage(fmt::format("{} and {} are both caches: one stream takes one", place, input));
      fail_usage(
          fmt::format("{} and {} are both meshes: name a sequence by its folder or by a pattern such as "
                      "walk_%04d.obj",
                      place, input));
    }
    place = input;
  }
  if (mesh.empty() && cache.empty())
    fail_usage(fmt::format("no input is given: {}; {}", kKnownFormats, kSceneFormats));
  if (mesh.empty()) fail_cache_alone(cache);
  return cache.empty() ? open_meshes(mesh, spec) : open_mesh_and_cache(mesh, cache, spec);
}

}  // namespace tvg::cli
