#pragma once
#include <string>

namespace tvg::player {

/// The path or URL that text from a clipboard or a drop names: its first line without white space around it,
/// and of a file's URI (file:///home/a%20b.tvg) the path. Empty where it names nothing.
std::string named_location(const std::string& text);

}  // namespace tvg::player
