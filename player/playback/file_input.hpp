#pragma once
#include "player/playback/stream_input.hpp"

#include <atomic>

namespace tvg::player {

/// A file. It may grow while it is read: its end is where it ends at the moment.
class FileInput final : public StreamInput {
 public:
  /// Takes over the descriptor of a regular file.
  FileInput(std::string name, int descriptor);
  ~FileInput() override;
  FileInput(const FileInput&) = delete;
  FileInput& operator=(const FileInput&) = delete;

  const std::string& name() const override { return name_; }
  std::optional<std::uint64_t> size() const override;
  Result<std::size_t> read(std::uint64_t offset, std::span<std::uint8_t> target) override;
  Result<std::vector<std::uint8_t>> read_aside(const ByteRange& range) override;
  bool reaches(std::uint64_t) const override { return true; }
  void interrupt() override {}
  void resume() override {}
  void cancel() override { cancelled_ = true; }
  std::vector<ByteRange> buffered() const override;
  InputStatus status() const override;

 private:
  std::string name_;
  int descriptor_;
  std::atomic<bool> cancelled_ = false;
};

}  // namespace tvg::player
