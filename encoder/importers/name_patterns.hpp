#pragma once
#include "tool/frame_pattern.hpp"

#include <string>
#include <vector>

namespace tvg::cli {

/// Names that differ in one number.
struct NamePattern {
  FramePattern pattern;             ///< as wide as the narrowest of the numbers that have leading zeros
  std::vector<NumberedFile> files;  ///< sorted by number
};

/// The pattern that most of the names have. A "-" before digits is a sign where names without it fit too, or
/// where a separator stands before it. A single name is a pattern of one; no files where there are no names.
NamePattern common_pattern(const std::vector<std::string>& names);

/// The names that are not of the pattern.
std::vector<std::string> names_without(const std::vector<std::string>& names, const NamePattern& pattern);

/// Runs of digits compare as numbers, all else as characters.
bool natural_less(const std::string& a, const std::string& b);

}  // namespace tvg::cli
