#pragma once
#include "encoder/importers/open_source.hpp"
#include "tool/input_files.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <tvg/encoder.hpp>

namespace CLI {
class App;
}

// What a user names as the animation, for every command that reads one whole.
namespace tvg::cli {

/// Values of the options as typed.
struct InputArguments {
  std::vector<std::string> inputs;
  std::string frames;
  std::string fps;
  std::string clip;
  std::vector<std::string> meshes;
  std::string skeleton;
  std::string gaps;
  std::string weld;
  std::string cache_up;
  std::string array;
  std::string normals = "auto";
  std::string attributes = "all";
  std::string uv_bits;
  std::string normal_bits;
  std::string colour_bits;
  bool embed_textures = false;
  bool skeleton_data = false;
};

/// Declares the inputs, --frames, --gaps, --weld, --cache-up, --clip, --mesh and --skeleton; `arguments` must
/// outlive the parsing. --fps is left to the command: what it means differs. `others`: what the command takes
/// beside these inputs.
void add_input_options(CLI::App& command, InputArguments& arguments, const std::string& others = "");

/// Declares --gaps and --weld alone.
void add_sequence_options(CLI::App& command, std::string& gaps, std::string& weld);
/// What they say, as typed. Throws ToolError (kUsage).
SequenceOptions sequence_options(const std::string& gaps, const std::string& weld);

/// Declares what is kept of the inputs beside positions: --attributes, --normals, --uv-bits, --normal-bits,
/// --colour-bits, --embed-textures and --skeleton-data. A command without them keeps what it can.
void add_property_options(CLI::App& command, InputArguments& arguments);
/// How fine attributes are, as these options say. Throws ToolError (kUsage).
AttributeBits attribute_bits(const InputArguments& arguments);

/// Declares --skeleton alone.
void add_skeleton_option(CLI::App& command, std::string& skeleton);

/// All files that the options name or imply, `weights` (may be empty) among them, so that no output
/// overwrites one.
InputFiles files_of(const InputArguments& arguments, const std::string& weights);

struct OpenedInput : OpenedSource {
  std::uint64_t first_frame = 0;  ///< of --frames
};

/// Opens a source with the joints of a file, as --skeleton takes it; without where `skeleton` is empty.
/// Throws as open_source(), read_skeleton_file() and with_joints() do.
OpenedSource open_with_joints(SourceSpec spec, const std::string& skeleton);

/// The joints of a .tvg, frames by its numbers, from a file as --skeleton takes it. Throws ToolError: kUsage
/// for a BVH file, and as read_skeleton_file() does.
JointTracks read_stream_joints(const std::string& skeleton);

/// Opens the inputs, with the joints of --skeleton. Throws as open_with_joints() does. `open_ended`: see
/// SourceSpec.
OpenedInput open_input(const InputArguments& arguments, bool open_ended);

/// Opens the inputs, or a .tvg with the joints of --skeleton, which takes no other of these options. Throws
/// as open_input() and read_stream_joints() do.
OpenedInput open_input_or_stream(const InputArguments& arguments);

/// The inputs, for messages: "hand.obj, hand.pc2".
std::string input_names(const InputArguments& arguments);

/// Prints what importing brought to light to standard error.
void print_notes(const OpenedSource& opened);

/// Prints what reading the frames brought to light since.
void print_later_notes(const OpenedSource& opened);

}  // namespace tvg::cli
