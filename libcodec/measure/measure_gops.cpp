#include "base/errors.hpp"
#include "source/gop_reader.hpp"
#include "source/source_checks.hpp"

#include <new>

#include <tvg/measure.hpp>

namespace tvg {

Status measure_gops(FrameSource& source, std::uint32_t gop_frames, const Importance& importance,
                    const GopMeasureSink& sink) {
  if (gop_frames == 0) return invalid_argument("a GOP must have frames");
  if (Status status = check_mesh(source.mesh()); !status.ok()) return status;
  if (Status status = check_importance(importance, source.mesh(), source.skeleton()); !status.ok())
    return status;
  try {
    GopReader reader(source, gop_frames, importance);
    const Measurer measurer(source.mesh(), source.skeleton(), importance);
    for (;;) {
      const Result<std::optional<GopContent>> gop = reader.next();
      if (!gop) return gop.error();
      if (!*gop) return {};
      const GopFrames& seen = *(*gop)->marked_by;
      Result<Measure> measured = measurer.measure(seen.frames, seen.joints);
      if (!measured) return measured.error();
      const GopFrames& content = *(*gop)->content;
      const GopMeasure given{(*gop)->first_frame, content.frames, content.joints, seen.frames.size(),
                             std::move(*measured)};
      if (Status status = sink(given); !status.ok()) return status;
    }
  } catch (const std::bad_alloc&) {
    return out_of_memory("there is not enough memory: use fewer frames per GOP");
  }
}

}  // namespace tvg
