#include "source/gop_reader.hpp"

#include "base/errors.hpp"
#include "source/source_checks.hpp"

namespace tvg {

Result<std::optional<GopContent>> GopReader::next() {
  while (!at_end_) {
    FramePositions frame(3 * std::size_t{source_.mesh().vertex_count});
    const Result<bool> read = read_checked(source_, frame, cutter_.frames());
    if (!read) return read.error();
    at_end_ = !*read;
    if (at_end_) break;
    std::vector<float> joints;
    if (with_joints_) {
      const std::span<const float> given = source_.joint_positions();
      if (Status status = check_joints(given, source_.skeleton(), cutter_.frames()); !status.ok())
        return status.error();
      joints.assign(given.begin(), given.end());
    }
    if (std::optional<GopContent> gop = cutter_.add(std::move(frame), std::move(joints))) return gop;
  }
  if (cutter_.frames() == 0) return invalid_input("the sequence has no frames");
  return cutter_.flush();
}

}  // namespace tvg
