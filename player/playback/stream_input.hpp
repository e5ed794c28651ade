#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tvg/decoder.hpp>

namespace tvg::player {

/// What an input is about, for people.
struct InputStatus {
  enum class Activity {
    kConnecting,  ///< no byte has come yet
    kReceiving,   ///< bytes come, or can be had at once
    kWaiting,     ///< a failed transfer will be tried again: `reason` says why
    kResting,     ///< far enough ahead of the reader, or complete
    kFailed,      ///< `reason` says why
  };

  Activity activity = Activity::kConnecting;
  std::string reason;
  std::uint64_t bytes_received = 0;  ///< over the network or the pipe, what came twice counted twice
};

/// The bytes of a stream, wherever they come from. One thread reads; every other function may be called from
/// any thread.
class StreamInput {
 public:
  virtual ~StreamInput() = default;

  /// The path, the URL or "standard input".
  virtual const std::string& name() const = 0;
  /// Size of the whole stream in bytes, once it is known.
  virtual std::optional<std::uint64_t> size() const = 0;
  /// Reads bytes from `offset` on into `target`: how many, 0 only at the end. Waits for the first of them.
  /// Fails with kIo and a message that names the input; also after interrupt() and cancel().
  virtual Result<std::size_t> read(std::uint64_t offset, std::span<std::uint8_t> target) = 0;
  /// Reads all of `range` without turning the input away from where read() is: for the index. May be called
  /// by a second thread at the same time. Fails with kIo, also where the input is read front to back only.
  virtual Result<std::vector<std::uint8_t>> read_aside(const ByteRange& range) = 0;
  /// Whether read() can go back to `offset`: a pipe and a live stream drop what is long past.
  virtual bool reaches(std::uint64_t offset) const = 0;
  /// After read() has failed: whether the input was a live one that is open again. Its offsets then count
  /// from 0 anew.
  virtual bool begin_anew() { return false; }

  /// Ends a read() that waits, and lets each one fail until resume().
  virtual void interrupt() = 0;
  virtual void resume() = 0;
  /// Ends every read, for good.
  virtual void cancel() = 0;

  /// The bytes on hand, in ascending order.
  virtual std::vector<ByteRange> buffered() const = 0;
  virtual InputStatus status() const = 0;
};

/// The input that `location` names: a path, "-" for standard input, or an http or https URL. Throws ToolError
/// (kIo) where a file cannot be opened; failures of the network are those of read(). Where bytes in between
/// may be left out, little is fetched ahead.
std::unique_ptr<StreamInput> open_stream_input(const std::string& location, bool leaves_out = false);

}  // namespace tvg::player
