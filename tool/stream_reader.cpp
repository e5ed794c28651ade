#include "tool/stream_reader.hpp"

#include "tool/option_values.hpp"
#include "tool/tool_error.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tvg::cli {

namespace {

ToolError io_error(const std::string& name, const std::string& what) {
  return {ExitStatus::kIo, fmt::format("{}: {}: {}", name, what, std::strerror(errno))};
}

constexpr std::size_t kPieceBytes = std::size_t{1} << 16;
constexpr std::uint64_t kMaxIndexBytes = std::uint64_t{1} << 26;

}  // namespace

StreamReader::StreamReader(const std::string& path)
    : name_(path == "-" ? "standard input" : path),
      remote_(is_address(path) ? open_remote_stream(path) : nullptr),
      descriptor_(path == "-" ? STDIN_FILENO
                  : remote_   ? -1
                              : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)),
      piece_(kPieceBytes) {
  if (remote_) {
    name_ = remote_->name();
    size_ = remote_->size();
    return;
  }
  if (descriptor_ < 0) throw io_error(name_, "cannot be opened");
  struct stat status {};
  if (::fstat(descriptor_, &status) == 0) {
    if (S_ISDIR(status.st_mode)) {
      throw ToolError(ExitStatus::kIo, fmt::format("{}: is a folder; a .tvg file is expected", name_));
    }
    if (S_ISREG(status.st_mode)) size_ = static_cast<std::uint64_t>(status.st_size);
    // A file that the shell redirects may have been read before, to be looked through.
    if (size_ && descriptor_ == STDIN_FILENO) ::lseek(descriptor_, 0, SEEK_SET);
  }
}

StreamReader::~StreamReader() {
  if (descriptor_ > STDIN_FILENO) ::close(descriptor_);
}

std::size_t StreamReader::read_some(void* target, std::size_t size) {
  if (remote_) {
    const std::size_t count = remote_->read(remote_position_, {static_cast<std::uint8_t*>(target), size});
    remote_position_ += count;
    return count;
  }
  for (;;) {
    const ssize_t count = ::read(descriptor_, target, size);
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno != EINTR) throw io_error(name_, "cannot be read");
  }
}

void StreamReader::use_lod(std::uint32_t lod) {
  constexpr std::size_t kSmallPiece = 4096;
  lod_ = lod;
  decoder_.use_lod(lod);
  if (lod > 0) piece_.resize(kSmallPiece);
}

std::string StreamReader::lod_note() const {
  if (lod_ == 0) return {};
  const std::string read =
      size_ ? fmt::format("{} of {} read", readable_bytes(bytes_read_), readable_bytes(*size_))
            : fmt::format("{} read", readable_bytes(bytes_read_));
  if (decoder_.mesh_info().lod == 0)
    return fmt::format("there is no coarser mesh: the whole is drawn, {}", read);
  return fmt::format("lod {} of {}: {} vertices, {}", decoder_.mesh_info().lod, decoder_.lod_count(),
                     decoder_.mesh().vertex_count, read);
}

Decoder::Event StreamReader::next() {
  for (;;) {
    const Decoder::Event event = decoder_.poll();
    if (event != Decoder::Event::kNeedBytes) return event;
    if (size_) {
      if (const std::uint64_t count = decoder_.skip(); count > 0) move_to(count, SEEK_CUR);
    }
    const std::size_t count = read_some(piece_.data(), piece_.size());
    if (count == 0) {
      decoder_.finish();
    } else {
      bytes_read_ += count;
      decoder_.push({piece_.data(), count});
    }
  }
}

std::vector<std::uint8_t> StreamReader::read_at(std::uint64_t offset, std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  std::size_t done = 0;
  while (done < size) {
    if (remote_) {
      const std::size_t count = remote_->read(offset + done, std::span(bytes).subspan(done));
      if (count == 0) break;
      done += count;
      continue;
    }
    const ssize_t count =
        ::pread(descriptor_, bytes.data() + done, size - done, static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw io_error(name_, "cannot be read");
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

std::size_t StreamReader::read_from(std::uint64_t offset, std::span<std::uint8_t> target) {
  if (size_) move_to(offset, SEEK_SET);
  return read_some(target.data(), target.size());
}

std::optional<StreamMap> StreamReader::read_index() {
  if (!size_ || *size_ < kTailBytes) return std::nullopt;
  const Result<ByteRange> range = locate_index(read_at(*size_ - kTailBytes, kTailBytes), *size_);
  if (!range || range->size > kMaxIndexBytes) return std::nullopt;
  const Result<std::vector<IndexEntry>> index =
      parse_index(read_at(range->offset, static_cast<std::size_t>(range->size)));
  if (!index) return std::nullopt;
  decoder_.set_index(*index);
  return StreamMap(*index);
}

void StreamReader::seek(std::uint64_t frame) {
  const Result<std::uint64_t> offset = decoder_.seek(frame);
  if (!offset) throw tool_error(name_, offset.error());
  move_to(*offset, SEEK_SET);
}

void StreamReader::move_to(std::uint64_t offset, int whence) {
  if (remote_) {
    remote_position_ = whence == SEEK_CUR ? remote_position_ + offset : offset;
    return;
  }
  if (::lseek(descriptor_, static_cast<off_t>(offset), whence) < 0) throw io_error(name_, "cannot be read");
}

std::string frame_run(std::uint64_t first, std::uint64_t count) {
  return count == 1 ? fmt::format("frame {}", first) : fmt::format("frames {}-{}", first, first + count - 1);
}

}  // namespace tvg::cli
