#include "player/frames/shown_frames.hpp"

#include "tool/stream_source.hpp"
#include "tool/tool_error.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace tvg::player {

const std::vector<float>& joints_at(const JointTracks& tracks, std::uint64_t frame,
                                    const std::string& stream) {
  if (frame < tracks.frames.size()) return tracks.frames[frame];
  throw cli::ToolError(
      cli::ExitStatus::kInvalidInput,
      fmt::format("the skeleton ends after {} frames, and {} goes on", tracks.frames.size(), stream));
}

std::string folder_of(const std::vector<std::string>& inputs) {
  namespace fs = std::filesystem;
  if (inputs.empty() || inputs.front() == "-") return {};
  std::error_code ignored;
  const fs::path path = inputs.front();
  if (fs::is_directory(path, ignored)) return path.string();
  return path.has_parent_path() ? path.parent_path().string() : ".";
}

bool is_stream(const std::vector<std::string>& inputs) {
  return inputs.size() == 1 && (inputs[0] == "-" || cli::is_stream_file(inputs[0]));
}

std::unique_ptr<ShownFrames> open_frames(const ShownFramesSpec& spec) {
  if (is_stream(spec.inputs)) return open_stream_frames(spec);
  if (spec.flags) {
    throw cli::ToolError(cli::ExitStatus::kUsage,
                         "--overlay importance: " + spec.inputs.front() +
                             " has no importance flags: encode it first, and name the .tvg");
  }
  return open_source_frames(spec);
}

}  // namespace tvg::player
