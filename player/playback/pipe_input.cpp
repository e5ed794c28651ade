#include "player/playback/pipe_input.hpp"

#include "player/playback/input_error.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>
#include <utility>

namespace tvg::player {

PipeInput::PipeInput(std::string name, int descriptor, std::uint64_t limit)
    : name_(std::move(name)),
      descriptor_(descriptor),
      wake_descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      limit_(std::max<std::uint64_t>(limit, 2)) {}

PipeInput::~PipeInput() {
  ::close(descriptor_);
  ::close(wake_descriptor_);
}

std::optional<std::uint64_t> PipeInput::size() const {
  const std::lock_guard lock(mutex_);
  if (!ended_) return std::nullopt;
  return kept_from_ + kept_.size();
}

Result<std::size_t> PipeInput::read(std::uint64_t offset, std::span<std::uint8_t> target) {
  for (;;) {
    {
      const std::lock_guard lock(mutex_);
      if (interrupted_ || cancelled_) return input_error(name_, "reading was ended");
      if (offset < kept_from_) {
        return input_error(name_, fmt::format("cannot go back to byte {}: of a pipe the last {} bytes are "
                                              "kept; play a file to go anywhere",
                                              offset, limit_));
      }
      const std::uint64_t end = kept_from_ + kept_.size();
      if (offset < end) {
        const auto at = static_cast<std::size_t>(offset - kept_from_);
        const std::size_t count = std::min(target.size(), kept_.size() - at);
        std::memcpy(target.data(), kept_.data() + at, count);
        return count;
      }
      if (ended_) return std::size_t{0};
    }
    const Result<bool> more = receive();
    if (!more) return more.error();
  }
}

Result<bool> PipeInput::receive() {
  std::array<pollfd, 2> waits = {pollfd{descriptor_, POLLIN, 0}, pollfd{wake_descriptor_, POLLIN, 0}};
  if (::poll(waits.data(), waits.size(), -1) < 0 && errno != EINTR)
    return input_error(name_, fmt::format("cannot be read: {}", std::strerror(errno)));
  if (waits[0].revents == 0) return true;
  std::array<std::uint8_t, 1 << 16> piece;
  const ssize_t count = ::read(descriptor_, piece.data(), piece.size());
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return true;
  if (count < 0) return input_error(name_, fmt::format("cannot be read: {}", std::strerror(errno)));
  const std::lock_guard lock(mutex_);
  if (count == 0) {
    ended_ = true;
    return false;
  }
  if (kept_.size() + static_cast<std::size_t>(count) > limit_) {  // half at a time, so that it costs little
    const std::size_t drop = std::min(kept_.size(), static_cast<std::size_t>(limit_ / 2));
    kept_.erase(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(drop));
    kept_from_ += drop;
  }
  kept_.insert(kept_.end(), piece.begin(), piece.begin() + count);
  return true;
}

Result<std::vector<std::uint8_t>> PipeInput::read_aside(const ByteRange&) {
  return input_error(name_, "is read front to back only");
}

bool PipeInput::reaches(std::uint64_t offset) const {
  const std::lock_guard lock(mutex_);
  return offset >= kept_from_;
}

void PipeInput::wake() {
  const std::uint64_t one = 1;
  // It fails only where the counter is full, and then the reader is awake.
  [[maybe_unused]] const ssize_t written = ::write(wake_descriptor_, &one, sizeof one);
}

void PipeInput::interrupt() {
  const std::lock_guard lock(mutex_);
  interrupted_ = true;
  wake();
}

void PipeInput::resume() {
  const std::lock_guard lock(mutex_);
  interrupted_ = false;
  std::uint64_t count = 0;
  [[maybe_unused]] const ssize_t read = ::read(wake_descriptor_, &count, sizeof count);
}

void PipeInput::cancel() {
  const std::lock_guard lock(mutex_);
  cancelled_ = true;
  wake();
}

std::vector<ByteRange> PipeInput::buffered() const {
  const std::lock_guard lock(mutex_);
  if (kept_.empty()) return {};
  return {{kept_from_, kept_.size()}};
}

InputStatus PipeInput::status() const {
  const std::lock_guard lock(mutex_);
  const std::uint64_t received = kept_from_ + kept_.size();
  if (ended_) return {InputStatus::Activity::kResting, "", received};
  return {received == 0 ? InputStatus::Activity::kConnecting : InputStatus::Activity::kReceiving, "",
          received};
}

}  // namespace tvg::player
