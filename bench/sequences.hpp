#pragma once
#include "codecs/errors.hpp"
#include "codecs/lattice_sequence.hpp"

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

}  // namespace tvg::bench
