#include "base/errors.hpp"
#include "encoder/encode_checks.hpp"
#include "encoder/settled_options.hpp"
#include "source/look_through.hpp"

#include <new>
#include <optional>
#include <utility>

#include <tvg/encoder.hpp>

namespace tvg {

namespace {

Result<EncodeReport> push_all(FrameSource& source, const EncodeOptions& given, const ByteSink& sink,
                              const EncodeProgress& progress) {
  std::optional<EncodePlan> plan;
  if (needs_plan(source, given)) {
    Result<std::optional<EncodePlan>> seen = look_through(source);
    if (!seen) return seen.error();
    plan = std::move(*seen);
  }
  Result<SettledOptions> settled = settle_options(source, given, plan ? &*plan : nullptr);
  if (!settled) return settled.error();
  add_data(settled->options.data, source.data());
  EncodeProgress with_total;
  if (progress) {
    with_total = [&progress, total = source.frame_count()](
                     std::uint64_t frames, std::optional<std::uint64_t>) { progress(frames, total); };
  }
  Encoder encoder(std::move(settled->options), sink, std::move(with_total));
  FramePositions frame;
  for (SourceStep step = SourceStep::kMesh; step != SourceStep::kEnd;) {
    Status status = step == SourceStep::kMesh
                        ? encoder.set_mesh(source.mesh(), source.skeleton(), source.properties())
                        : encoder.add_frame(frame, source.joint_positions(), all_animated_values(source));
    if (!status.ok()) return status.error();
    const Result<SourceStep> next = read_step(source, frame);
    if (!next) return next.error();
    step = *next;
  }
  Result<EncodeReport> report = encoder.finish();
  if (report) report->captured = settled->captured;
  return report;
}

}  // namespace

Result<EncodeReport> encode(FrameSource& source, const EncodeOptions& options, const ByteSink& sink,
                            const EncodeProgress& progress) {
  if (Status status = check_encoding(source, options); !status.ok()) return status.error();
  try {
    return push_all(source, options, sink, progress);
  } catch (const std::bad_alloc&) {
    return out_of_memory("there is not enough memory: use fewer frames per GOP or fewer threads");
  }
}

}  // namespace tvg
