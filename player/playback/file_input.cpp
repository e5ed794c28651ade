#include "player/playback/file_input.hpp"

#include "player/playback/input_error.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace tvg::player {

FileInput::FileInput(std::string name, int descriptor) : name_(std::move(name)), descriptor_(descriptor) {}

FileInput::~FileInput() {
  ::close(descriptor_);
}

std::optional<std::uint64_t> FileInput::size() const {
  struct stat facts {};
  if (::fstat(descriptor_, &facts) != 0) return std::nullopt;
  return static_cast<std::uint64_t>(facts.st_size);
}

Result<std::size_t> FileInput::read(std::uint64_t offset, std::span<std::uint8_t> target) {
  for (;;) {
    if (cancelled_) return input_error(name_, "reading was ended");
    const ssize_t count = ::pread(descriptor_, target.data(), target.size(), static_cast<off_t>(offset));
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno != EINTR) return input_error(name_, fmt::format("cannot be read: {}", std::strerror(errno)));
  }
}

Result<std::vector<std::uint8_t>> FileInput::read_aside(const ByteRange& range) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(range.size));
  for (std::size_t done = 0; done < bytes.size();) {
    const Result<std::size_t> count = read(range.offset + done, std::span(bytes).subspan(done));
    if (!count) return count.error();
    if (*count == 0) return input_error(name_, "ends early");
    done += *count;
  }
  return bytes;
}

std::vector<ByteRange> FileInput::buffered() const {
  const std::optional<std::uint64_t> bytes = size();
  if (!bytes || *bytes == 0) return {};
  return {{0, *bytes}};
}

InputStatus FileInput::status() const {
  return {InputStatus::Activity::kResting, "", 0};
}

}  // namespace tvg::player
