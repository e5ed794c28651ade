#pragma once
#include <string>

namespace tvg::player {

/// The file of a sans-serif outline font that this system has: DejaVu Sans where it is installed, or else
/// what fontconfig takes in its place. Empty where there is none.
std::string find_font();

}  // namespace tvg::player
