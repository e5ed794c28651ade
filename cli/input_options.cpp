#include "cli/input_options.hpp"

#include "encoder/importers/scene_file.hpp"
#include "encoder/importers/skeleton_file.hpp"
#include "tool/mesh_format.hpp"
#include "tool/option_values.hpp"
#include "tool/stream_source.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <fmt/format.h>

namespace tvg::cli {

void add_sequence_options(CLI::App& command, std::string& gaps, std::string& weld) {
  command
      .add_option("--gaps", gaps,
                  "numbers that a sequence leaves out, and files without faces: hold the frame before, skip "
                  "them, or refuse (default: refuse the former; the latter are frames that show nothing; "
                  "a number every N is no gap)")
      ->check(CLI::IsMember({"hold", "skip", "refuse"}));
  command.add_option(
      "--weld", weld,
      "corners of STL are one vertex where they lie no further apart than this, in the mesh's "
      "units (0.001) or as a share of the diagonal of the first frame's box (default 0.0001%)");
}

void add_input_options(CLI::App& command, InputArguments& arguments, const std::string& others) {
  command
      .add_option(
          "input", arguments.inputs,
          "a mesh (OBJ, PLY, OFF, STL) and its cache (PC2, PC16, MDD, NPY, NPZ; - for standard input), or a "
          "sequence of "
          "mesh files: a folder, a pattern (walk_%04d.obj, walk_####.obj, %04d/mesh.obj) or the "
          "files, or a scene (glTF 2, FBX, COLLADA, X, "
          "MD5, MD2, ...)" +
              others)
      ->required();
  command.add_option("--frames", arguments.frames, "frames A-B only, counted from 0");
  add_sequence_options(command, arguments.gaps, arguments.weld);
  command
      .add_option(
          "--cache-up", arguments.cache_up,
          "the axis that is up in the cache, where its mesh has the other (Blender: OBJ y, MDD z): the "
          "cache is turned to the mesh")
      ->check(CLI::IsMember({"y", "z"}));
  command.add_option("--array", arguments.array,
                     "the array of a .npz that has the positions (default: the one that fits the mesh)");
  command.add_option("--clip", arguments.clip,
                     "the clip of a scene, by name or number (default: the first); tvg info lists them");
  command.add_option(
      "--mesh", arguments.meshes,
      "a mesh of a scene, by its name or its node's, or by number; may be repeated (default: all)");
  add_skeleton_option(command, arguments.skeleton);
}

void add_property_options(CLI::App& command, InputArguments& arguments) {
  command
      .add_option("--attributes", arguments.attributes,
                  "what is kept beside positions: all that the input has (texture coordinates, normals, "
                  "colours, parts, materials), or none")
      ->check(CLI::IsMember({"all", "none"}))
      ->capture_default_str();
  command
      .add_option(
          "--normals", arguments.normals,
          "drop leaves them to the player, keep keeps them, auto drops those that the faces give anyway")
      ->check(CLI::IsMember({"auto", "keep", "drop"}))
      ->capture_default_str();
  command.add_option("--uv-bits", arguments.uv_bits,
                     "bits per texture coordinate, 1 to 24, or exact (default 12)");
  command.add_option("--normal-bits", arguments.normal_bits,
                     "bits of each of a normal's two coordinates, 1 to 16, or exact (default 10)");
  command.add_option("--colour-bits", arguments.colour_bits,
                     "bits per component of a colour, 1 to 24, or exact (default 8; 12 for those of glTF "
                     "that are no bytes)");
  command.add_flag("--embed-textures", arguments.embed_textures,
                   "put the files of textures into the stream; without it, it has their names");
  command.add_flag("--skeleton-data", arguments.skeleton_data,
                   "keep the names of a scene's joints and where they are in each frame");
}

namespace {

/// A number of bits as typed; `exact` is 0.
int bits_typed(const char* option, const std::string& text, int usual, int most) {
  if (text.empty()) return usual;
  if (text == "exact") return Attribute::kExact;
  int bits = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), bits);
  if (error != std::errc() || end != text.data() + text.size() || bits < 0 || bits > most)
    fail_option(option, text, fmt::format("write a number of bits from 1 to {}, or exact", most));
  return bits;
}

PropertyOptions property_options(const InputArguments& arguments) {
  PropertyOptions options;
  options.wanted = arguments.attributes != "none";
  if (arguments.normals == "keep") options.normals = NormalsChoice::kKeep;
  if (arguments.normals == "drop") options.normals = NormalsChoice::kDrop;
  options.fine_linear_colours = arguments.colour_bits.empty();
  options.embed_textures = arguments.embed_textures;
  return options;
}

}  // namespace

AttributeBits attribute_bits(const InputArguments& arguments) {
  AttributeBits bits;
  bits.texcoord = bits_typed("--uv-bits", arguments.uv_bits, bits.texcoord, kMaxAttributeBits);
  bits.normal = bits_typed("--normal-bits", arguments.normal_bits, bits.normal, kMaxNormalBits);
  bits.colour = bits_typed("--colour-bits", arguments.colour_bits, bits.colour, kMaxAttributeBits);
  return bits;
}

SequenceOptions sequence_options(const std::string& gaps, const std::string& weld) {
  SequenceOptions options;
  options.empty_frames = gaps.empty();
  if (gaps == "hold") options.gaps = Gaps::kHold;
  if (gaps == "skip") options.gaps = Gaps::kSkip;
  if (weld.empty()) return options;
  std::string number = weld;
  options.weld.of_diagonal = number.ends_with('%');
  if (options.weld.of_diagonal) number.pop_back();
  const NumberRange from_zero{.least = 0};
  options.weld.value = parse_number("--weld", number, from_zero) / (options.weld.of_diagonal ? 100 : 1);
  return options;
}

void add_skeleton_option(CLI::App& command, std::string& skeleton) {
  command.add_option("--skeleton", skeleton,
                     "the joints of a cache or sequence: a BVH file (frame by frame where it has as many, "
                     "else by time), or JSON as tvg_corpus writes it");
}

InputFiles files_of(const InputArguments& arguments, const std::string& weights) {
  InputFiles files;
  files.add(with_scene_files(arguments.inputs));
  files.add(arguments.skeleton);
  files.add(weights);
  return files;
}

OpenedSource open_with_joints(SourceSpec spec, const std::string& skeleton) {
  const bool motion_capture = has_suffix(skeleton, ".bvh");
  if (motion_capture) spec.skeleton = skeleton;
  OpenedSource opened = open_source(spec);
  if (skeleton.empty() || motion_capture) return opened;
  opened.source = with_joints(std::move(opened.source), read_skeleton_file(skeleton), skeleton,
                              spec.frames ? spec.frames->first : 0);
  return opened;
}

JointTracks read_stream_joints(const std::string& skeleton) {
  if (has_suffix(skeleton, ".bvh")) fail_option("--skeleton", skeleton, "a .tvg takes its joints from JSON");
  return read_skeleton_file(skeleton);
}

OpenedInput open_input(const InputArguments& arguments, bool open_ended) {
  if (!arguments.fps.empty()) static_cast<void>(parse_rate(arguments.fps));
  OpenedInput opened;
  SourceSpec spec{arguments.inputs, {}};
  spec.scene = {arguments.clip, arguments.meshes, arguments.fps};
  spec.scene.skeleton_data = arguments.skeleton_data;
  spec.open_ended = open_ended;
  spec.sequence = sequence_options(arguments.gaps, arguments.weld);
  spec.sequence.properties = property_options(arguments);
  spec.cache_up = arguments.cache_up;
  spec.array = arguments.array;
  if (!arguments.frames.empty()) {
    spec.frames = parse_frame_range(arguments.frames);
    opened.first_frame = spec.frames->first;
  }
  static_cast<OpenedSource&>(opened) = open_with_joints(std::move(spec), arguments.skeleton);
  return opened;
}

OpenedInput open_input_or_stream(const InputArguments& input) {
  if (input.inputs.size() != 1 || !is_stream_file(input.inputs.front())) return open_input(input, false);
  for (const auto& [option, given] :
       {std::pair("--frames", !input.frames.empty()), std::pair("--clip", !input.clip.empty()),
        std::pair("--mesh", !input.meshes.empty()), std::pair("--fps", !input.fps.empty())}) {
    if (given) {
      throw ToolError(ExitStatus::kUsage,
                      fmt::format("{}: not for a .tvg, whose frames are taken as they are", option));
    }
  }
  OpenedInput opened;
  opened.source = std::make_unique<StreamSource>(input.inputs.front());
  if (input.skeleton.empty()) return opened;
  opened.source =
      with_joints(std::move(opened.source), read_stream_joints(input.skeleton), input.skeleton, 0);
  return opened;
}

std::string input_names(const InputArguments& arguments) {
  return fmt::format("{}", fmt::join(arguments.inputs, ", "));
}

void print_notes(const OpenedSource& opened) {
  for (const std::string& note : opened.notes) fmt::print(stderr, "note: {}\n", note);
}

void print_later_notes(const OpenedSource& opened) {
  if (!opened.later) return;
  for (const std::string& note : opened.later->texts()) fmt::print(stderr, "note: {}\n", note);
}

}  // namespace tvg::cli
