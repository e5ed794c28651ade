#pragma once
#include "tool/source_opener.hpp"

#include <string>

namespace tvg::cli {

/// The importers, for what shows frames. `skeleton`: the file of their joints, as --skeleton takes it; may be
/// empty.
SourceOpener source_opener(const std::string& skeleton = "");

}  // namespace tvg::cli
