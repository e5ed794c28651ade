#pragma once
#include <vector>

#include <tvg/metrics.hpp>
#include <tvg/source.hpp>

namespace tvg::bench {

/// The figures of `tvg compare`. Throws ToolError where the frames cannot be compared.
ComparisonReport compare(const Sequence& original, const std::vector<FramePositions>& decoded,
                         const ComparisonSettings& settings = {});

}  // namespace tvg::bench
