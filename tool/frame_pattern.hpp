#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tvg::cli {

/// The numbered names of a sequence of files, as a user writes them: "walk_%04d.obj", "walk_%d.obj" or
/// "walk_####.obj" (which is the same as %04d). The number is in the file's name, not in its folder's.
struct FramePattern {
  std::string folder;     ///< with its "/" at the end, or empty
  std::string prefix;     ///< of the file's name
  std::string suffix;     ///< of the file's name, ".obj" with it
  std::size_t width = 0;  ///< numbers are padded with zeros to this many digits

  /// The path of one frame.
  std::string path(std::uint64_t number) const;

  /// The number that `file_name` (no folder) stands for; nothing where it is not one of the pattern's names.
  std::optional<std::uint64_t> number_of(std::string_view file_name) const;
};

/// The pattern in `path`; nothing where it has none.
std::optional<FramePattern> parse_frame_pattern(const std::string& path);

}  // namespace tvg::cli
