#include "encoder/live/live_encoding.hpp"

#include "encoder/live/pacer.hpp"

#include <utility>

namespace tvg::cli {

namespace {

/// What comes next, of a loop from its beginning again; `shown` is the mesh that the encoder knows of.
Result<SourceStep> read_on(FrameSource& source, const LiveInput& input, const Mesh& shown,
                           FramePositions& frame) {
  Result<SourceStep> read = read_step(source, frame);
  if (!read || *read != SourceStep::kEnd || !input.loop || shown.vertex_count == 0 || !source.rewind())
    return read;
  return source.mesh() == shown ? read_step(source, frame) : SourceStep::kMesh;
}

}  // namespace

Result<LiveReport> encode_live(FrameSource& source, EncodeOptions options, const LiveInput& input,
                               const ByteSink& sink, const EncodeProgress& progress) {
  options.metadata.merge(source.metadata());
  Encoder encoder(std::move(options), sink, progress);
  LiveReport report;
  Mesh shown;  // once it has a frame
  FramePositions frame;
  Pacer pacer(input.pace);
  bool waited = false;  // for the frame that comes next
  for (Result<SourceStep> step = SourceStep::kMesh; *step != SourceStep::kEnd;) {
    const bool is_mesh = *step == SourceStep::kMesh;
    Status status = is_mesh ? encoder.set_mesh(source.mesh(), source.skeleton(), source.properties())
                            : encoder.add_frame(frame, source.joint_positions(), all_animated_values(source));
    if (!status.ok()) return status.error();
    if (!is_mesh && shown.vertex_count == 0) shown = source.mesh();
    if (is_mesh) shown = {};
    if (!is_mesh) waited = false;
    // A mesh takes no time of its own.
    if (!std::exchange(waited, true)) pacer.wait_for_next();
    step = read_on(source, input, shown, frame);
    if (step) continue;
    if (!input.open_ended || step.error().code != ErrorCode::kTruncated) return step.error();
    report.cut_short = step.error().message;
    break;
  }
  const Result<EncodeReport> made = encoder.finish();
  if (!made) return made.error();
  static_cast<EncodeReport&>(report) = *made;
  return report;
}

}  // namespace tvg::cli
