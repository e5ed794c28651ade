#include "codecs/errors.hpp"

#include "tool/tool_error.hpp"

namespace tvg::bench {

ComparisonReport compare(const Sequence& original, const std::vector<FramePositions>& decoded,
                         const ComparisonSettings& settings) {
  SequenceComparison comparison(original.mesh, settings);
  for (std::size_t f = 0; f < original.frames.size(); ++f) {
    const Status status = comparison.add_frame(original.frames[f], decoded.at(f));
    if (!status.ok()) throw cli::tool_error("comparison", status.error());
  }
  return comparison.report();
}

}  // namespace tvg::bench
