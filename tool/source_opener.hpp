#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tvg/source.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// Opens the frames of files that are no .tvg, those of a range or all. What shows frames knows no importer:
/// the command hands it one. Throws ToolError.
using SourceOpener = std::function<std::unique_ptr<FrameSource>(const std::vector<std::string>&,
                                                                const std::optional<FrameRange>&)>;

}  // namespace tvg::cli
