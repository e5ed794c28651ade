#pragma once
#include "tool/source_opener.hpp"

namespace tvg::cli {

/// The importers, for what shows frames.
SourceOpener source_opener();

}  // namespace tvg::cli
