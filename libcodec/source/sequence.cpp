#include <algorithm>

#include <tvg/source.hpp>

namespace tvg {

const MeshProperties& FrameSource::properties() const {
  static const MeshProperties none;
  return none;
}

const Skeleton& FrameSource::skeleton() const {
  static const Skeleton none;
  return none;
}

Status FrameSource::skip_frames(std::uint64_t count) {
  FramePositions frame;
  while (count > 0) {
    const Result<SourceStep> step = read_step(*this, frame);
    if (!step) return step.error();
    if (*step == SourceStep::kEnd)
      return Error{ErrorCode::kInvalidArgument, "the sequence ends before the frames to be passed over"};
    if (*step == SourceStep::kFrame) --count;
  }
  return {};
}

std::vector<std::span<const float>> all_animated_values(const FrameSource& source) {
  std::vector<std::span<const float>> values;
  const std::vector<Attribute>& attributes = source.properties().attributes;
  for (std::size_t i = 0; i < attributes.size(); ++i)
    values.push_back(attributes[i].animated ? source.animated_values(i) : std::span<const float>());
  return values;
}

Result<SourceStep> read_step(FrameSource& source, FramePositions& frame) {
  frame.resize(3 * std::size_t{source.mesh().vertex_count});
  const Result<bool> read = source.read_frame(frame);
  if (read) return *read ? SourceStep::kFrame : SourceStep::kEnd;
  const Result<bool> changed = source.begin_next_mesh();
  if (!changed) return changed.error();
  if (!*changed) return read.error();
  return SourceStep::kMesh;
}

const Skeleton& SequenceSource::skeleton() const {
  return joints_ != nullptr ? joints_->skeleton : FrameSource::skeleton();
}

std::span<const float> SequenceSource::joint_positions() const {
  if (joints_ == nullptr || next_ == 0 || next_ > joints_->frames.size()) return {};
  return joints_->frames[next_ - 1];
}

Result<bool> SequenceSource::read_frame(std::span<float> positions) {
  if (next_ == sequence_.frames.size()) return false;
  const FramePositions& frame = sequence_.frames[next_];
  if (frame.size() != positions.size()) {
    Error error{ErrorCode::kInvalidInput,
                "frame " + std::to_string(next_) + " has " + std::to_string(frame.size() / 3) +
                    " vertices where the mesh has " + std::to_string(positions.size() / 3),
                {},
                {},
                ""};
    error.frame = next_;
    return error;
  }
  std::copy(frame.begin(), frame.end(), positions.begin());
  ++next_;
  return true;
}

}  // namespace tvg
