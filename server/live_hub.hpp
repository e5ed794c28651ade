#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <tvg/relay.hpp>

// Live streams between those who publish them and those who watch: what is in memory, and who waits for whom.
// Nothing here knows HTTP. All of it may be called from any thread.
namespace tvg::server {

using SharedBytes = std::shared_ptr<const std::vector<std::uint8_t>>;

/// A GOP that viewers can be given.
struct LiveGop {
  std::uint64_t number = 0;         ///< of the GOP in its live stream, counted from 0
  SharedBytes mesh;                 ///< chunk of the mesh it belongs to
  std::vector<SharedBytes> planes;  ///< chunks of those it needs
  SharedBytes chunk;
  std::uint32_t frame_count = 0;
};

/// What a listing says about a live stream.
struct LiveStatus {
  std::string name;
  std::uint64_t viewers = 0;
  std::uint64_t frames = 0;
  std::uint64_t gops = 0;
  std::uint64_t bytes = 0;
  double seconds = 0;      ///< since it began
  std::int64_t since = 0;  ///< when it began, in seconds since 1970
};

/// One live stream: keeps the newest GOPs, the meshes and the planes in force, and the data it begins with,
/// as far as each take no more memory than these, and nothing per viewer. A viewer comes with the number of
/// the GOP it wants next; one that comes too late for it is given the newest instead.
class LiveStream {
 public:
  /// GOPs kept for viewers that are a little late, and the bytes they may take together; the newest is kept
  /// whatever its size.
  static constexpr std::size_t kKeptGops = 4;

  explicit LiveStream(std::uint64_t kept_bytes) : kept_bytes_(kept_bytes) {}

  /// Takes a part of the stream; kEnd ends it. False when the stream has been ended.
  bool add(StreamPart part);
  /// Nothing follows; viewers get what is kept and then an end.
  void end();

  struct Start {
    StreamLimits limits;
    Metadata metadata;
    std::vector<SharedBytes> data;  ///< chunks of those that came before the first mesh
  };
  /// What a viewer needs first; waits for it until there is a mesh. Nothing when the stream ends before or
  /// the time is up.
  std::optional<Start> wait_for_start(std::chrono::milliseconds time);

  enum class Wait { kGop, kNothingYet, kEnded };
  /// Waits for the GOP `wanted`, or gives a newer one where that is not kept any more. `wanted` absent: the
  /// newest there is, so that who joins sees a picture at once.
  Wait next(std::optional<std::uint64_t> wanted, std::chrono::milliseconds time, LiveGop& gop);

  void viewer_joined();
  void viewer_left();
  LiveStatus status() const;

 private:
  struct NamedChunk {
    std::uint32_t name = 0;
    SharedBytes chunk;
  };
  /// Those that GOPs to come may name, the latest last.
  using ChunksInForce = std::deque<NamedChunk>;

  void add_data(SharedBytes chunk);
  void add_named(ChunksInForce& in_force, std::size_t most, std::uint32_t name, SharedBytes chunk) const;
  void add_gop(StreamPart part);
  void keep_newest();

  const std::uint64_t kept_bytes_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  const std::chrono::system_clock::time_point since_ = std::chrono::system_clock::now();
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Start start_;
  ChunksInForce meshes_;
  ChunksInForce plans_;
  std::deque<LiveGop> newest_;  ///< oldest first, numbers without a gap
  bool ended_ = false;
  std::uint64_t viewers_ = 0;
  std::uint64_t frames_ = 0;
  std::uint64_t gops_ = 0;
  std::uint64_t bytes_ = 0;
};

class LiveHub;

/// The right to publish under a name. The destructor ends the stream and frees the name.
class LivePublisher {
 public:
  LivePublisher(LiveHub& hub, std::string name, std::shared_ptr<LiveStream> stream,
                const RelayLimits& limits);
  ~LivePublisher();
  LivePublisher(const LivePublisher&) = delete;
  LivePublisher& operator=(const LivePublisher&) = delete;

  /// Takes the next bytes of the upload and gives viewers what they complete. Errors as StreamSplitter has
  /// them; kIo when the server has ended the stream.
  Status push(std::span<const std::uint8_t> bytes);
  /// No bytes follow: kTruncated when the stream was not complete.
  Status finish() const { return splitter_.finish(); }
  LiveStatus status() const { return stream_->status(); }

 private:
  LiveHub& hub_;
  std::string name_;
  std::shared_ptr<LiveStream> stream_;
  StreamSplitter splitter_;
};

/// Why a stream cannot be published.
enum class PublishRefusal { kNameTaken, kTooMany, kEnding };

/// All live streams, by name.
class LiveHub {
 public:
  LiveHub(std::size_t most_streams, const RelayLimits& limits)
      : most_streams_(most_streams), limits_(limits) {}

  /// Whether publish() would be refused now.
  std::optional<PublishRefusal> refusal(const std::string& name) const;
  std::variant<std::unique_ptr<LivePublisher>, PublishRefusal> publish(const std::string& name);
  /// Null when nobody publishes under that name.
  std::shared_ptr<LiveStream> find(const std::string& name) const;
  std::vector<LiveStatus> list() const;
  /// Ends every stream and refuses new ones.
  void end_all();

 private:
  friend class LivePublisher;
  void remove(const std::string& name);
  std::optional<PublishRefusal> refusal_locked(const std::string& name) const;

  const std::size_t most_streams_;
  const RelayLimits limits_;
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<LiveStream>> streams_;
  bool ending_ = false;
};

/// What one viewer has been given so far. Holds one GOP at a time and an index of 48 bytes per GOP.
class LiveViewer {
 public:
  /// After so many GOPs the viewer's stream is ended properly, so that its index does not grow forever; it
  /// may join again.
  static constexpr std::uint64_t kMostGops = std::uint64_t{1} << 18;

  LiveViewer(std::shared_ptr<LiveStream> stream, LiveStream::Start start);
  ~LiveViewer();
  LiveViewer(const LiveViewer&) = delete;
  LiveViewer& operator=(const LiveViewer&) = delete;

  enum class Step { kGoOn, kDone, kFailed };
  /// Writes what comes next, waiting up to `time` for it; kFailed when the sink fails.
  Step step(const ByteSink& sink, std::chrono::milliseconds time);

 private:
  Status write_next(std::chrono::milliseconds time, bool& done);

  std::shared_ptr<LiveStream> stream_;
  LiveStream::Start start_;
  const ByteSink* sink_ = nullptr;  ///< of the step under way
  StreamAssembler assembler_;
  SharedBytes mesh_;                 ///< of the GOP written last
  std::vector<SharedBytes> planes_;  ///< of that GOP
  std::optional<std::uint64_t> wanted_;
};

}  // namespace tvg::server
