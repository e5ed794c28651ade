#include "encoder/importers/open_source.hpp"

#include "encoder/importers/cache_source.hpp"
#include "encoder/importers/frame_range.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/mesh_sequence.hpp"
#include "encoder/importers/properties_source.hpp"
#include "encoder/importers/quarter_turn.hpp"
#include "encoder/importers/scene_file.hpp"
#include "encoder/importers/scene_source.hpp"
#include "encoder/importers/sequence_files.hpp"
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
    "meshes are .obj, .ply, .off or .stl, caches are .pc2, .pc16, .mdd, .npy or .npz, sequences are folders "
    "or "
    "patterns "
    "such as "
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
  if (path.find_first_of("*?[") != path.npos && !fs::exists(path, ignored) && !parse_input_pattern(path)) {
    const std::string around = sequence_around(path);
    throw ImportError(ErrorCode::kIo,
                      fmt::format("there is no file {}, and *, ? and [] are no patterns here: {}", path,
                                  around.empty() ? "write %d in the place of the number, as in walk_%04d.obj"
                                                 : "there is " + around));
  }
  if (mesh_format(path)) return;
  if (!fs::exists(path, ignored) && !parse_input_pattern(path)) {
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

/// The source with its cache turned where that is asked for; else a note where it looks as if it should be.
std::unique_ptr<FrameSource> turned(std::unique_ptr<FrameSource> source, const SourceSpec& spec,
                                    const std::string& cache, const std::string& mesh_path,
                                    const std::vector<float>& positions, std::vector<std::string>& notes) {
  if (!spec.cache_up.empty())
    return std::make_unique<TurnedSource>(std::move(source),
                                          spec.cache_up == "z" ? Turn::kZUpToYUp : Turn::kYUpToZUp);
  if (cache == "-") return source;
  std::vector<float> first(positions.size());
  const Result<bool> read = source->read_frame(first);
  const std::optional<Turn> turn = read && *read ? find_quarter_turn(positions, first) : std::nullopt;
  if (!source->rewind()) throw ImportError(ErrorCode::kIo, "cannot read " + cache + " twice");
  if (turn) {
    const bool z_up = *turn == Turn::kZUpToYUp;
    notes.push_back(
        fmt::format("{} is turned by a quarter against {}: it has {} up where the mesh has {}. "
                    "`--cache-up {}` turns it to the mesh",
                    cache, mesh_path, z_up ? "z" : "y", z_up ? "y" : "z", z_up ? "z" : "y"));
  }
  return source;
}

OpenedSource open_mesh_and_cache(const std::string& mesh_path, const std::string& cache,
                                 const SourceSpec& spec) {
  std::error_code ignored;
  if (fs::is_directory(mesh_path, ignored) ||
      (parse_input_pattern(mesh_path) && !fs::exists(mesh_path, ignored))) {
    fail_usage(fmt::format("{} goes with one mesh file, and {} is a sequence", cache, mesh_path));
  }
  WeldedMesh welded = read_welded_mesh(mesh_path, spec.sequence);
  Metadata metadata;
  if (!welded.mesh.name.empty()) metadata.emplace("name", welded.mesh.name);
  if (welded.properties.flat()) metadata.emplace("shading", "flat");
  Mesh mesh{static_cast<std::uint32_t>(welded.mesh.vertex_count()), std::move(welded.mesh.faces)};
  CacheOptions options;
  options.open_ended = spec.open_ended;
  options.array = spec.array;
  if (!spec.scene.fps.empty()) options.frame_rate = parse_rate(spec.scene.fps);
  auto source = open_cache(cache, std::move(mesh), std::move(metadata), mesh_path, welded.notes, options);
  source = std::make_unique<PropertiesSource>(std::move(source), welded.properties.properties(),
                                              std::move(welded.data));
  source = turned(std::move(source), spec, cache, mesh_path, welded.mesh.positions, welded.notes);
  const std::optional<std::uint64_t> known = source->frame_count();
  if (!known && !spec.skeleton.empty())
    fail_usage("--skeleton needs to know the number of frames: not from a pipe");
  const std::uint64_t frame_count = known.value_or(std::numeric_limits<std::uint64_t>::max());
  source = with_skeleton(std::move(source), spec, 0, frame_count, welded.notes);
  if (!spec.frames) return {std::move(source), std::move(welded.notes)};
  check_frame_range(*spec.frames, frame_count, cache == "-" ? "standard input" : cache);
  return {std::make_unique<FrameRangeSource>(std::move(source), *spec.frames), std::move(welded.notes)};
}

/// The files that one input stands for, or several.
SequenceFiles find_files(const std::vector<std::string>& inputs, Gaps gaps) {
  std::error_code ignored;
  if (inputs.size() > 1) return order_listed_files(inputs, gaps);
  if (fs::is_directory(inputs[0], ignored)) return find_folder_files(inputs[0], gaps);
  if (auto numbered = find_pattern_files(inputs[0], gaps)) return std::move(*numbered);
  SequenceFiles one{inputs, {}};
  const std::string around = sequence_around(inputs[0]);
  if (!around.empty()) {
    one.notes.push_back(fmt::format("{} looks like one file of the sequence {}: it is taken as one frame",
                                    inputs[0], around));
  }
  return one;
}

/// The coordinates of all frames are relative to what the first frame of the whole sequence says, so that
/// parts of it fit together.
void settle_origin(const std::string& first, SequenceOptions& options) {
  if (options.origin) return;
  MeshFile mesh;
  std::string buffer;
  try {
    read_located_mesh(first, mesh_format(first).value(), buffer, mesh);
  } catch (const ImportError&) {
    return;  // not among the frames that are wanted: they say it themselves
  }
  options.origin = mesh.origin.value_or(Origin{});
}

OpenedSource open_meshes(const std::vector<std::string>& inputs, const SourceSpec& spec) {
  const std::optional<FrameRange>& frames = spec.frames;
  SequenceOptions options = spec.sequence;
  auto [files, notes] = find_files(inputs, options.gaps);
  const std::uint64_t frame_count = files.size();
  if (frames) {
    check_frame_range(*frames, frame_count, inputs[0]);
    if (frames->first > 0) settle_origin(files[0], options);
    // The range picks files before the first is read: connectivity may differ outside it.
    files.erase(files.begin() + static_cast<std::ptrdiff_t>(frames->last) + 1, files.end());
    files.erase(files.begin(), files.begin() + static_cast<std::ptrdiff_t>(frames->first));
  }
  const std::uint64_t first_frame = frames ? frames->first : 0;
  auto sequence = std::make_unique<MeshSequenceSource>(std::move(files), options, first_frame);
  notes.insert(notes.end(), sequence->notes().begin(), sequence->notes().end());
  std::shared_ptr<ReadNotes> later = sequence->later_notes();
  auto source = with_skeleton(std::move(sequence), spec, first_frame, frame_count, notes);
  return {std::move(source), std::move(notes), std::move(later)};
}

/// A mesh file alone, with the cache that lies beside it under its name.
std::optional<OpenedSource> open_with_cache_beside(const std::string& mesh, const SourceSpec& spec) {
  std::error_code ignored;
  if (!mesh_format(mesh) || !fs::is_regular_file(mesh, ignored)) return std::nullopt;
  const std::vector<std::string> caches = caches_beside(mesh);
  if (caches.empty()) return std::nullopt;
  if (caches.size() > 1) {
    fail_usage(
        fmt::format("{} lie beside {}: name the one that goes with it", fmt::join(caches, " and "), mesh));
  }
  OpenedSource opened = open_mesh_and_cache(mesh, caches[0], spec);
  opened.notes.insert(opened.notes.begin(),
                      fmt::format("{} lies beside {} and is taken as its frames", caches[0], mesh));
  return opened;
}

OpenedSource open_scene_alone(const SourceSpec& spec, const std::string& path) {
  if (spec.inputs.size() > 1) {
    fail_usage(fmt::format("{} is a scene, which brings its own motion: it is the only input", path));
  }
  if (!spec.skeleton.empty()) {
    fail_usage(
        fmt::format("--skeleton {}: {} is a scene, which brings its own skeleton", spec.skeleton, path));
  }
  SceneOptions options = spec.scene;
  options.frames = spec.frames;
  options.properties = spec.sequence.properties;
  OpenedScene opened = open_scene(path, options);
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
  std::vector<std::string> meshes;
  std::string cache;
  std::error_code ignored;
  for (const std::string& input : spec.inputs) {
    check_known(input);
    if (!is_cache(input)) {
      meshes.push_back(input);
      continue;
    }
    if (!cache.empty())
      fail_usage(fmt::format("{} and {} are both caches: one stream takes one", cache, input));
    cache = input;
  }
  for (const std::string& mesh : meshes) {
    if (meshes.size() > 1 && (!cache.empty() || !fs::is_regular_file(mesh, ignored))) {
      fail_usage(
          fmt::format("{} and {} are both meshes: name a sequence by its folder, by a pattern such as "
                      "walk_%04d.obj, or by all its files",
                      meshes[0], meshes[1]));
    }
  }
  if (meshes.empty() && cache.empty())
    fail_usage(fmt::format("no input is given: {}; {}", kKnownFormats, kSceneFormats));
  if (meshes.empty()) fail_cache_alone(cache);
  if (!cache.empty()) return open_mesh_and_cache(meshes[0], cache, spec);
  if (meshes.size() == 1) {
    if (auto beside = open_with_cache_beside(meshes[0], spec)) return std::move(*beside);
  }
  if (!spec.cache_up.empty()) fail_usage("--cache-up is for a cache, and there is none");
  return open_meshes(meshes, spec);
}

}  // namespace tvg::cli
