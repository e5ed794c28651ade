#include "encoder/importers/input_file.hpp"

#include "encoder/importers/import_error.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace tvg::cli {

InputFile::InputFile(const std::string& path) : name_(path == "-" ? "standard input" : path) {
  descriptor_ = path == "-" ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail("open", errno);
  struct stat status {};
  const bool known = fstat(descriptor_, &status) == 0;
  if (known && S_ISDIR(status.st_mode)) {
    if (descriptor_ != STDIN_FILENO) close(descriptor_);
    fail("read", EISDIR);
  }
  // Standard input is read front to back even where it is a file: someone else may have read its first bytes.
  if (known && S_ISREG(status.st_mode) && path != "-") size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() {
  if (descriptor_ >= 0 && descriptor_ != STDIN_FILENO) close(descriptor_);
}

void InputFile::fail(const char* what, int error_number) const {
  throw ImportError(ErrorCode::kIo, fmt::format("cannot {} {}: {}", what, name_,
                                                std::generic_category().message(error_number)));
}

std::size_t InputFile::read(void* data, std::size_t size) {
  std::size_t filled = 0;
  while (filled < size) {
    const ssize_t got = ::read(descriptor_, static_cast<char*>(data) + filled, size - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("read", errno);
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
  }
  return filled;
}

void InputFile::seek(std::uint64_t offset) {
  if (lseek(descriptor_, static_cast<off_t>(offset), SEEK_SET) < 0) fail("read", errno);
}

void read_file(const std::string& path, std::string& bytes, std::uint64_t most_unsized) {
  InputFile file(path);
  const std::uint64_t most = std::max(file.size().value_or(0), most_unsized);
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  std::size_t filled = 0;
  // One byte more than the file is said to have, so that its end shows in the first read.
  bytes.resize(file.size() ? *file.size() + 1 : std::min<std::uint64_t>(kBlock, most + 1));
  for (;;) {
    filled += file.read(bytes.data() + filled, bytes.size() - filled);
    if (filled < bytes.size()) break;
    if (filled > most) {
      bytes = {};
      throw ImportError(ErrorCode::kInvalidInput,
                        fmt::format("{} goes on after byte {}, and more is read of a regular file only: copy "
                                    "it to one",
                                    file.name(), most));
    }
    bytes.resize(std::min<std::uint64_t>(bytes.size() + std::max(bytes.size(), kBlock), most + 1));
  }
  bytes.resize(filled);
  if (filled == 0) throw EmptyInputError(file.name() + " is empty");
}

void require_regular_file(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode) || S_ISDIR(status.st_mode)) return;
  throw ImportError(ErrorCode::kIo,
                    fmt::format("cannot read {}: it is a pipe or a device, and a file of this "
                                "kind is read more than once: copy it to a regular file",
                                path));
}

std::optional<std::string> recognize_content(const std::string& bytes) {
  struct Magic {
    std::size_t offset;
    std::string_view bytes;
    const char* meaning;
  };
  using namespace std::string_view_literals;
  static constexpr std::array kMagics = {
      Magic{1, "TVG\r\n"sv, "a TVG stream already (`tvg decode` turns it into meshes)"},
      Magic{0, "\x89PNG"sv, "a PNG image"},
      Magic{0, "\xff\xd8\xff"sv, "a JPEG image"},
      Magic{0, "PK\x03\x04"sv, "a ZIP archive"},
      Magic{0, "\x1f\x8b"sv, "gzip-compressed"},
      Magic{0, "\x28\xb5\x2f\xfd"sv, "zstd-compressed"},
      Magic{0, "glTF"sv, "a binary glTF file"},
      Magic{0, "POINTCACHE2"sv, "a PC2 cache"},
      Magic{0, "Kaydara FBX"sv, "an FBX file"},
      Magic{0, "Ogawa"sv, "an Alembic file"},
      Magic{0, "BLENDER"sv, "a Blender file"},
      Magic{0, "%PDF"sv, "a PDF document"},
  };
  for (const Magic& magic : kMagics) {
    if (std::string_view(bytes).substr(std::min(magic.offset, bytes.size())).starts_with(magic.bytes)) {
      return magic.meaning;
    }
  }
  return std::nullopt;
}

}  // namespace tvg::cli
