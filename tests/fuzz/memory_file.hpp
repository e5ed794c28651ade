#pragma once
#include "fuzz/require.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <fcntl.h>
#include <span>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace tvg::fuzz {

/// Bytes under a name that readers of files can open: a regular file in memory, or a pipe that ends after
/// them.
class MemoryFile {
 public:
  enum class Kind { kRegular, kPipe };
  /// The bytes that every pipe takes without a reader.
  static constexpr std::size_t kMostPiped = 4096;

  MemoryFile(std::span<const std::uint8_t> bytes, Kind kind) {
    int writer = -1;
    if (kind == Kind::kRegular) {
      writer = descriptor_ = memfd_create("fuzz", MFD_CLOEXEC);
    } else {
      std::array<int, 2> ends = {-1, -1};
      require(bytes.size() <= kMostPiped && pipe(ends.data()) == 0);
      descriptor_ = ends[0];
      writer = ends[1];
    }
    require(write(writer, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
    if (kind == Kind::kPipe) close(writer);
    path_ = "/proc/self/fd/" + std::to_string(descriptor_);
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  int descriptor_ = -1;
  std::string path_;
};

}  // namespace tvg::fuzz
