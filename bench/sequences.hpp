#pragma once
#include "bench/other_codecs.hpp"

#include <string>
#include <vector>

#include <tvg/metrics.hpp>
#include <tvg/source.hpp>

namespace tvg::bench {

struct NamedSequence {
  std::string name;
  Sequence sequence;
};

/// Where sequences are looked for: $TVG_DATA_DIR; empty where it is not set.
std::string default_data_folder();

/// The stems of every NAME.obj in `folder` that has a NAME.pc2 beside it, sorted; none when there is no such
/// folder.
std::vector<std::string> names_in(const std::string& folder);

/// NAME.obj and NAME.pc2 of `folder`. Throws ToolError as the importers do.
NamedSequence load(const std::string& folder, const std::string& name);

/// The first `count` frames, or all there are.
Sequence first_frames(const Sequence& sequence, std::size_t count);

/// The lattice of the format: index = floor((x - minimum) / step), step = largest extent / 2^bits over all
/// frames.
struct Lattice {
  LatticeSequence indices;
  double minimum[3] = {};
  double step = 0;

  /// Every index as the centre of its cell, [frame][vertex][xyz].
  std::vector<FramePositions> centres() const;
};

Lattice quantize(const Sequence& sequence, int bits);

/// The figures of `tvg compare`.
ComparisonReport compare(const Sequence& original, const std::vector<FramePositions>& decoded);

}  // namespace tvg::bench
