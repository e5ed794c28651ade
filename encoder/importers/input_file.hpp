#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace tvg::cli {

/// An open file, pipe or device; "-" is standard input. Failures are ImportError (kIo) and name the file.
class InputFile {
 public:
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// As messages call it: the path, or "standard input".
  const std::string& name() const { return name_; }
  /// Bytes of a regular file; nothing for a pipe.
  std::optional<std::uint64_t> size() const { return size_; }
  /// Reads up to `size` bytes; fewer only at the end of the file.
  std::size_t read(void* data, std::size_t size);
  /// Goes to a byte of a regular file.
  void seek(std::uint64_t offset);

 private:
  [[noreturn]] void fail(const char* what, int error_number) const;

  std::string name_;
  int descriptor_ = -1;
  std::optional<std::uint64_t> size_;
};

/// Bytes that are read of a pipe, a device or another file whose size the system does not know: some have no
/// end.
inline constexpr std::uint64_t kMostUnsizedBytes = std::uint64_t{1} << 29;

/// Reads a whole file into `bytes`, whose capacity is reused. An empty file is an
/// EmptyInputError; one is an ImportError (kInvalidInput) that goes on beyond the size the system says and
/// `most_unsized` bytes.
void read_file(const std::string& path, std::string& bytes, std::uint64_t most_unsized = kMostUnsizedBytes);

/// Throws ImportError (kIo) where `path` names a pipe or a device, without opening it: for files that are
/// opened more than once.
void require_regular_file(const std::string& path);

/// What the first bytes of a file say it is ("a PNG image"), for the formats that users confuse; nothing for
/// others.
std::optional<std::string> recognize_content(const std::string& bytes);

}  // namespace tvg::cli
