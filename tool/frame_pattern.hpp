#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tvg::cli {

/// The numbered names of a sequence of files, as a user writes them: "walk_%04d.obj", "walk_%d.obj" or
/// "walk_####.obj" (which is the same as %04d). Of what is read, the number may be in a folder's name too:
/// "%04d/mesh.obj".
struct FramePattern {
  std::string folder;     ///< with its "/" at the end, or empty
  std::string prefix;     ///< of the file's name
  std::string suffix;     ///< of the file's name, ".obj" with it
  std::size_t width = 0;  ///< numbers are padded with zeros to this many digits
  std::string tail = {};  ///< what follows the folder that has the number: "/mesh.obj"; may have it again

  /// The path of one frame.
  std::string path(std::uint64_t number) const;
  /// The same for a number that may be below 0: -2 is "-002" where 2 is "0002".
  std::string signed_path(std::int64_t number) const;

  /// The number that `name` (no folder before it, no tail) stands for; nothing where it is not one of the
  /// pattern's names. Below 0 it may have as many digits as above, or the sign among them.
  std::optional<std::int64_t> number_of(std::string_view name) const;

  /// As a user writes it, with %d.
  std::string text() const;
};

/// The pattern in the last part of `path`; nothing where it has none.
std::optional<FramePattern> parse_frame_pattern(const std::string& path);

/// The pattern of files to read: in the name of the file, of one of its folders, or of both.
std::optional<FramePattern> parse_input_pattern(const std::string& path);

struct NumberedFile {
  std::int64_t number = 0;
  std::string path;
};

/// The files of a pattern that exist, by number. Nothing where its folder cannot be read.
std::optional<std::vector<NumberedFile>> numbered_files(const FramePattern& pattern);

}  // namespace tvg::cli
