#include "player/playback/remote_input.hpp"

#include "player/playback/http_input.hpp"
#include "tool/tool_error.hpp"

#include <array>

namespace tvg::player {

namespace {

/// Commands read once and do not wait for anything but bytes: little needs to be kept or be there ahead.
HttpOptions options_for_reading() {
  HttpOptions options;
  options.read_ahead = std::uint64_t{4} << 20;
  options.cache_bytes = std::uint64_t{16} << 20;
  return options;
}

class RemoteInput final : public cli::RemoteStream {
 public:
  explicit RemoteInput(const std::string& url) : input_(url, options_for_reading()) {
    std::array<std::uint8_t, 1> first{};
    static_cast<void>(read(0, first));  // the size is known once bytes come
  }

  const std::string& name() const override { return input_.name(); }
  std::optional<std::uint64_t> size() const override { return size_; }
  std::size_t read(std::uint64_t offset, std::span<std::uint8_t> target) override {
    const Result<std::size_t> count = input_.read(offset, target);
    if (!count) throw cli::ToolError(cli::ExitStatus::kIo, count.error().message);
    // A live stream has a size in the end, but cannot be read again.
    if (!asked_) size_ = input_.reaches(0) && *count > 0 ? input_.size() : std::nullopt;
    asked_ = true;
    return *count;
  }

 private:
  HttpInput input_;
  std::optional<std::uint64_t> size_;
  bool asked_ = false;
};

}  // namespace

std::unique_ptr<cli::RemoteStream> open_remote_input(const std::string& url) {
  return std::make_unique<RemoteInput>(url);
}

}  // namespace tvg::player
