#include "encoder/live/live_encoding.hpp"

#include "encoder/live/pacer.hpp"

#include <utility>

namespace tvg::cli {

namespace {

/// The next frame, of a loop from its beginning again; `any`: whether there was one before.
Result<bool> read_on(FrameSource& source, const LiveInput& input, bool any, FramePositions& frame) {
  Result<bool> read = source.read_frame(frame);
  if (read && !*read && input.loop && any && source.rewind()) return source.read_frame(frame);
  return read;
}

}  // namespace

Result<LiveReport> encode_live(FrameSource& source, EncodeOptions options, const LiveInput& input,
                               const ByteSink& sink, const EncodeProgress& progress) {
  options.metadata.merge(source.metadata());
  Encoder encoder(std::move(options), sink, progress);
  if (Status status = encoder.set_mesh(source.mesh(), source.skeleton()); !status.ok()) return status.error();
  LiveReport report;
  FramePositions frame(3 * std::size_t{source.mesh().vertex_count});
  Pacer pacer(input.pace);
  for (bool any = false;; any = true) {
    pacer.wait_for_next();
    const Result<bool> read = read_on(source, input, any, frame);
    if (!read) {
      if (!input.open_ended || read.error().code != ErrorCode::kTruncated) return read.error();
      report.cut_short = read.error().message;
    }
    if (!read || !*read) break;
    if (Status status = encoder.add_frame(frame, source.joint_positions()); !status.ok())
      return status.error();
  }
  const Result<EncodeReport> made = encoder.finish();
  if (!made) return made.error();
  static_cast<EncodeReport&>(report) = *made;
  return report;
}

}  // namespace tvg::cli
