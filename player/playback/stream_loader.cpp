#include "player/playback/stream_loader.hpp"

#include <algorithm>
#include <exception>
#include <utility>

// What other threads ask of the loader, and the thread that fetches the index. stream_decoding.cpp has the
// rest.
namespace tvg::player {

namespace {

constexpr std::uint64_t kMaxIndexBytes = std::uint64_t{1} << 26;

}  // namespace

StreamLoader::StreamLoader(std::unique_ptr<StreamInput> input, const LoaderOptions& options)
    : options_(options),
      input_(std::move(input)),
      ring_(options.ring_frames),
      piece_(options.lod > 0 ? std::size_t{1} << 12 : std::size_t{1} << 16) {
  index_thread_ = std::thread([this] { load_index(); });
  thread_ = std::thread([this] { run(); });
}

StreamLoader::~StreamLoader() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  input_->cancel();
  work_->ring();
  index_.notify_all();
  thread_.join();
  index_thread_.join();
}

std::shared_ptr<const PlayerFrame> StreamLoader::show(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const PlayerFrame> frame = ring_.show(number);
  if (frame) work_->ring();
  return frame;
}

bool StreamLoader::heads_for(std::uint64_t number) const {
  const std::lock_guard lock(mutex_);
  if (request_) return number >= request_->frame && number - request_->frame <= ring_.capacity();
  return active_ && ring_.has_room() && number >= ring_.next() && number - ring_.next() <= ring_.capacity();
}

void StreamLoader::seek(std::uint64_t number, std::uint64_t lead_in) {
  const std::lock_guard lock(mutex_);
  if (!request_ && ring_.contains(number)) return;
  request({number, lead_in});
}

/// Hands the decoding thread a new place to go on from. Called with the lock held.
void StreamLoader::request(const Request& request) {
  ring_.reset(request.frame);
  request_ = request;
  active_ = true;
  state_.state = opened_ ? LoaderSnapshot::State::kReady : LoaderSnapshot::State::kOpening;
  state_.message.clear();
  input_->interrupt();
  work_->ring();
}

void StreamLoader::set_loop(std::optional<LoopRange> loop) {
  const std::lock_guard lock(mutex_);
  loop_ = loop;
  work_->ring();
}

void StreamLoader::set_decorator(std::shared_ptr<FrameDecorator> decorator, std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  decorator_ = std::move(decorator);
  request({number, 0});
}

LoaderSnapshot StreamLoader::snapshot() const {
  LoaderSnapshot snapshot;
  {
    const std::lock_guard lock(mutex_);
    snapshot = state_;
    snapshot.frame_count = facts_.frame_count();
    snapshot.known_frames = facts_.known_end();
    snapshot.gops = facts_.gop_marks();
    snapshot.has_index = facts_.has_index();
    snapshot.damage = facts_.damage();
    snapshot.decoded = ring_.runs();
    snapshot.frames_ahead = ring_.ahead();
    snapshot.ring_capacity = ring_.capacity();
  }
  snapshot.stream_bytes = input_->size();
  snapshot.input = input_->status();
  snapshot.buffered = frames_of_bytes(*snapshot.gops, input_->buffered());
  if (snapshot.message.empty()) snapshot.message = snapshot.input.reason;
  return snapshot;
}

std::vector<FrameBytes> StreamLoader::frame_bytes(std::uint64_t first, std::uint64_t last) const {
  const std::lock_guard lock(mutex_);
  return facts_.frame_bytes(first, last);
}

StreamLoader::Supply StreamLoader::supply() const {
  const std::lock_guard lock(mutex_);
  Supply supply;
  supply.ahead = ring_.ahead();
  supply.failed = state_.state == LoaderSnapshot::State::kFailed;
  supply.complete = !request_ && (!active_ || !ring_.has_room());
  supply.can_go_back = !began_anew_ && input_->reaches(0);
  supply.frame_count = facts_.frame_count();
  return supply;
}

void StreamLoader::load_index() {
  {
    std::unique_lock lock(mutex_);
    index_.wait(lock, [this] { return wants_index_ || stopped_; });
    if (stopped_) return;
  }
  try {
    find_index();
  } catch (const std::exception&) {  // no memory for it: everything is found by reading on
  }
  const std::lock_guard lock(mutex_);
  index_done_ = true;
  work_->ring();
}

void StreamLoader::find_index() {
  std::uint64_t end = 0;
  std::optional<std::vector<IndexEntry>> entries = fetch_index(end);
  if (!entries) return;
  const std::lock_guard lock(mutex_);
  facts_.use_index(*entries, end);
  new_index_ = std::move(entries);
}

/// The stream's index, where it has one; `end` is its offset. Without one everything is found by reading on.
std::optional<std::vector<IndexEntry>> StreamLoader::fetch_index(std::uint64_t& end) {
  const std::optional<std::uint64_t> size = input_->size();
  if (!size || *size < kTailBytes) return std::nullopt;
  const Result<std::vector<std::uint8_t>> tail = input_->read_aside({*size - kTailBytes, kTailBytes});
  if (!tail) return std::nullopt;
  const Result<ByteRange> range = locate_index(*tail, *size);
  if (!range || range->size > kMaxIndexBytes) return std::nullopt;
  const Result<std::vector<std::uint8_t>> chunk = input_->read_aside(*range);
  if (!chunk) return std::nullopt;
  Result<std::vector<IndexEntry>> index = parse_index(*chunk);
  if (!index) return std::nullopt;
  end = range->offset;
  return std::move(*index);
}

}  // namespace tvg::player
