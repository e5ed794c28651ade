#include "player/overlay/reference_frames.hpp"

#include "tool/tool_error.hpp"

#include <fmt/format.h>
#include <utility>

namespace tvg::player {

ReferenceFrames::ReferenceFrames(ShownFramesSpec spec, std::string shown)
    : spec_(std::move(spec)), shown_(std::move(shown)), frames_(open_frames(spec_)) {}

bool ReferenceFrames::rewind() {
  if (!frames_->rewind()) return false;
  frame_.mesh.reset();
  return true;
}

bool ReferenceFrames::read_on_to(std::uint64_t number) {
  if (end_ && number >= *end_) return false;
  if (frame_.mesh && frame_.number > number && !rewind()) {
    frames_ = open_frames(spec_);
    frame_.mesh.reset();
  }
  while (!frame_.mesh || frame_.number < number) {
    if (frames_->next(frame_)) continue;
    end_ = frame_.mesh ? frame_.number + 1 : 0;
    return false;
  }
  return true;
}

const ShownFrame& ReferenceFrames::at(std::uint64_t number) {
  if (read_on_to(number)) return frame_;
  throw cli::ToolError(
      cli::ExitStatus::kInvalidInput,
      fmt::format("{} ends before frame {}, which {} has: a reference needs every frame that is "
                  "shown",
                  spec_.inputs.back(), number, shown_));
}

const ShownFrame& ReferenceFrames::same_mesh_at(std::uint64_t number, std::size_t vertices,
                                                bool keeps_vertex_order) {
  const ShownFrame& frame = at(number);
  const std::string& name = spec_.inputs.front();
  if (keeps_vertex_order != frames_->keeps_vertex_order()) {
    throw cli::ToolError(
        cli::ExitStatus::kUsage,
        fmt::format("--overlay error: {} gave up the order of its vertices, so that none can be "
                    "found in {}",
                    keeps_vertex_order ? name : shown_, keeps_vertex_order ? shown_ : name));
  }
  if (frame.mesh->vertex_count != vertices) {
    throw cli::ToolError(
        cli::ExitStatus::kInvalidInput,
        fmt::format("{} has {} vertices and {} has {} at frame {}: errors are between frames of one mesh",
                    shown_, vertices, name, frame.mesh->vertex_count, number));
  }
  return frame;
}

}  // namespace tvg::player
