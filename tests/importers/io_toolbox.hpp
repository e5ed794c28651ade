#pragma once
#include "tool/tool_error.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

#include <tvg/source.hpp>

namespace tvg::cli::testing {

/// A folder for one test's files, removed at its end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tvg-io-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, std::string_view bytes) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path(name);
  }
  std::string read(const std::string& name) const {
    std::ifstream file(path_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::filesystem::path path_;
};

/// Bytes of numbers in the given order.
class ByteString {
 public:
  explicit ByteString(bool big_endian) : big_endian_(big_endian) {}

  template <class T>
  ByteString& add(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (big_endian_) std::reverse(bytes, bytes + sizeof(T));
    bytes_.append(bytes, sizeof(T));
    return *this;
  }
  ByteString& text(std::string_view text) {
    bytes_ += text;
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  bool big_endian_;
  std::string bytes_;
};

/// A tetrahedron that moves: four vertices, four faces.
inline const std::vector<Face> kTetrahedron = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

inline FramePositions tetrahedron_positions(std::size_t frame) {
  const float t = 0.1F * static_cast<float>(frame);
  return {t, 0, 0, 1 + t, 0, 0, t, 1, 0.125F, t, -0.5F, 1 + t};
}

inline std::string pc2_bytes(std::int32_t points, std::int32_t frames, std::int32_t frames_written) {
  ByteString bytes(false);
  bytes.text(std::string_view("POINTCACHE2", 12))
      .add(std::int32_t{1})
      .add(points)
      .add(0.0F)
      .add(1.0F)
      .add(frames);
  for (std::int32_t frame = 0; frame < frames_written; ++frame) {
    for (const float value : tetrahedron_positions(static_cast<std::size_t>(frame))) bytes.add(value);
  }
  return bytes.bytes();
}

inline std::string mdd_bytes(std::int32_t points, std::int32_t frames, std::int32_t frames_written,
                             double step) {
  ByteString bytes(true);
  bytes.add(frames).add(points);
  for (std::int32_t frame = 0; frame < frames; ++frame) bytes.add(static_cast<float>(frame * step));
  for (std::int32_t frame = 0; frame < frames_written; ++frame) {
    for (const float value : tetrahedron_positions(static_cast<std::size_t>(frame))) bytes.add(value);
  }
  return bytes.bytes();
}

/// The error that `action` throws, which must be one.
template <class Action>
ToolError thrown_by(Action&& action) {
  try {
    action();
  } catch (const ToolError& error) {
    return error;
  }
  ADD_FAILURE() << "nothing was thrown";
  return {ExitStatus::kSuccess, ""};
}

/// Reads a source to its end or its first error.
struct Frames {
  std::vector<FramePositions> frames;
  std::optional<Error> error;
};

inline Frames read_all(FrameSource& source) {
  Frames result;
  for (;;) {
    FramePositions positions(3 * std::size_t{source.mesh().vertex_count});
    const Result<bool> read = source.read_frame(positions);
    if (!read) result.error = read.error();
    if (!read || !*read) return result;
    result.frames.push_back(std::move(positions));
  }
}

/// The folder of real sequences; empty where it is absent.
inline std::string data_folder() {
  const char* variable = std::getenv("TVG_DATA_DIR");
  const std::string folder = variable != nullptr ? variable : "";
  return std::filesystem::is_regular_file(folder + "/crane.pc2") ? folder : "";
}

}  // namespace tvg::cli::testing
