#pragma once
#include "player/playback/stream_input.hpp"

#include <condition_variable>
#include <mutex>

namespace tvg::player {

/// Bytes that come once, front to back: a pipe, a terminal, a socket. What has come is kept, so that one can
/// go back, up to a limit beyond which the oldest bytes are dropped.
class PipeInput : public StreamInput {
 public:
  static constexpr std::uint64_t kDefaultLimit = std::uint64_t{256} << 20;

  /// Takes over the descriptor. Keeps between half of `limit` bytes and all of it.
  PipeInput(std::string name, int descriptor, std::uint64_t limit = kDefaultLimit);
  ~PipeInput() override;
  PipeInput(const PipeInput&) = delete;
  PipeInput& operator=(const PipeInput&) = delete;

  const std::string& name() const override { return name_; }
  std::optional<std::uint64_t> size() const override;
  Result<std::size_t> read(std::uint64_t offset, std::span<std::uint8_t> target) override;
  Result<std::vector<std::uint8_t>> read_aside(const ByteRange& range) override;
  bool reaches(std::uint64_t offset) const override;
  void interrupt() override;
  void resume() override;
  void cancel() override;
  std::vector<ByteRange> buffered() const override;
  InputStatus status() const override;

 private:
  /// Waits for bytes and appends them; false at the end.
  Result<bool> receive();
  void wake();

  std::string name_;
  int descriptor_;
  int wake_descriptor_;
  std::uint64_t limit_;

  mutable std::mutex mutex_;
  std::vector<std::uint8_t> kept_;
  std::uint64_t kept_from_ = 0;  ///< offset in the stream of the first byte kept
  bool ended_ = false;
  bool interrupted_ = false;
  bool cancelled_ = false;
};

}  // namespace tvg::player
