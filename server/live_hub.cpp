#include "server/live_hub.hpp"

#include <algorithm>
#include <utility>

namespace tvg::server {

namespace {

SharedBytes shared(std::vector<std::uint8_t> bytes) {
  return std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
}

}  // namespace

bool LiveStream::add(StreamPart part) {
  const std::lock_guard lock(mutex_);
  if (ended_) return false;
  bytes_ += part.chunk.size();
  switch (part.kind) {
    case StreamPart::Kind::kHead:
      start_.limits = part.limits;
      break;
    case StreamPart::Kind::kMetadata:
      start_.metadata = std::move(part.metadata);
      break;
    case StreamPart::Kind::kData:
      add_data(shared(std::move(part.chunk)));
      break;
    case StreamPart::Kind::kMesh:
      add_named(meshes_, start_.limits.meshes, part.mesh, shared(std::move(part.chunk)));
      break;
    case StreamPart::Kind::kPlan:
      add_named(plans_, start_.limits.plans, part.planes.front(), shared(std::move(part.chunk)));
      break;
    case StreamPart::Kind::kGop:
      add_gop(std::move(part));
      break;
    case StreamPart::Kind::kEnd:
      ended_ = true;
      break;
  }
  changed_.notify_all();
  return true;
}

/// Those that come once viewers may have begun are left out, so that all viewers have the same.
void LiveStream::add_data(SharedBytes chunk) {
  if (!meshes_.empty()) return;
  std::uint64_t bytes = chunk->size();
  for (const SharedBytes& known : start_.data) bytes += known->size();
  if (bytes <= kept_bytes_) start_.data.push_back(std::move(chunk));
}

void LiveStream::add_named(ChunksInForce& in_force, std::size_t most, std::uint32_t name,
                           SharedBytes chunk) const {
  std::erase_if(in_force, [name](const NamedChunk& known) { return known.name == name; });
  in_force.push_back({name, std::move(chunk)});
  std::uint64_t bytes = 0;
  std::size_t kept = 0;
  for (auto known = in_force.rbegin(); known != in_force.rend() && kept < most; ++known, ++kept) {
    bytes += known->chunk->size();
    if (kept > 0 && bytes > kept_bytes_) break;
  }
  in_force.erase(in_force.begin(), in_force.end() - static_cast<std::ptrdiff_t>(kept));
}

void LiveStream::add_gop(StreamPart part) {
  const auto find = [](const ChunksInForce& in_force, std::uint32_t name) {
    const auto chunk = std::ranges::find(in_force, name, &NamedChunk::name);
    return chunk == in_force.end() ? nullptr : chunk->chunk;
  };
  frames_ += part.frame_count;
  LiveGop gop{gops_, find(meshes_, part.mesh), {}, nullptr, part.frame_count};
  for (const std::uint32_t name : part.planes) gop.planes.push_back(find(plans_, name));
  const bool kept = gop.mesh != nullptr && std::ranges::count(gop.planes, nullptr) == 0;
  if (!kept) return;  // of a mesh or planes that took too much memory to keep
  gop.chunk = shared(std::move(part.chunk));
  newest_.push_back(std::move(gop));
  ++gops_;
  keep_newest();
}

void LiveStream::keep_newest() {
  std::uint64_t bytes = 0;
  std::size_t kept = 0;
  for (auto gop = newest_.rbegin(); gop != newest_.rend() && kept < kKeptGops; ++gop, ++kept) {
    bytes += gop->chunk->size();
    if (kept > 0 && bytes > kept_bytes_) break;
  }
  newest_.erase(newest_.begin(), newest_.end() - static_cast<std::ptrdiff_t>(kept));
}

void LiveStream::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

std::optional<LiveStream::Start> LiveStream::wait_for_start(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, time, [this] { return !meshes_.empty() || ended_; });
  if (meshes_.empty()) return std::nullopt;
  return start_;
}

LiveStream::Wait LiveStream::next(std::optional<std::uint64_t> wanted, std::chrono::milliseconds time,
                                  LiveGop& gop) {
  std::unique_lock lock(mutex_);
  const auto available = [&] { return !newest_.empty() && newest_.back().number >= wanted.value_or(0); };
  changed_.wait_for(lock, time, [&] { return available() || ended_; });
  if (!available()) return ended_ ? Wait::kEnded : Wait::kNothingYet;
  const std::uint64_t oldest = newest_.front().number;
  const bool in_time = wanted && *wanted >= oldest;
  gop = in_time ? newest_[static_cast<std::size_t>(*wanted - oldest)] : newest_.back();
  return Wait::kGop;
}

void LiveStream::viewer_joined() {
  const std::lock_guard lock(mutex_);
  ++viewers_;
}

void LiveStream::viewer_left() {
  const std::lock_guard lock(mutex_);
  --viewers_;
}

LiveStatus LiveStream::status() const {
  const std::lock_guard lock(mutex_);
  return {"",
          viewers_,
          frames_,
          gops_,
          bytes_,
          std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count(),
          std::chrono::system_clock::to_time_t(since_)};
}

LivePublisher::LivePublisher(LiveHub& hub, std::string name, std::shared_ptr<LiveStream> stream,
                             const RelayLimits& limits)
    : hub_(hub), name_(std::move(name)), stream_(std::move(stream)), splitter_(limits) {}

LivePublisher::~LivePublisher() {
  hub_.remove(name_);
  stream_->end();
}

Status LivePublisher::push(std::span<const std::uint8_t> bytes) {
  if (Status status = splitter_.push(bytes); !status.ok()) return status;
  for (;;) {
    Result<std::optional<StreamPart>> part = splitter_.next();
    if (!part) return part.error();
    if (!*part) return {};
    if (!stream_->add(std::move(**part))) return Error{ErrorCode::kIo, "the server is ending", {}, {}, ""};
  }
}

std::optional<PublishRefusal> LiveHub::refusal_locked(const std::string& name) const {
  if (ending_) return PublishRefusal::kEnding;
  if (streams_.contains(name)) return PublishRefusal::kNameTaken;
  if (streams_.size() >= most_streams_) return PublishRefusal::kTooMany;
  return std::nullopt;
}

std::optional<PublishRefusal> LiveHub::refusal(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return refusal_locked(name);
}

std::variant<std::unique_ptr<LivePublisher>, PublishRefusal> LiveHub::publish(const std::string& name) {
  const std::lock_guard lock(mutex_);
  if (const auto refused = refusal_locked(name)) return *refused;
  auto stream = std::make_shared<LiveStream>(limits_.chunk_bytes);
  streams_.emplace(name, stream);
  return std::make_unique<LivePublisher>(*this, name, std::move(stream), limits_);
}

void LiveHub::remove(const std::string& name) {
  const std::lock_guard lock(mutex_);
  streams_.erase(name);
}

std::shared_ptr<LiveStream> LiveHub::find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = streams_.find(name);
  return found == streams_.end() ? nullptr : found->second;
}

std::vector<LiveStatus> LiveHub::list() const {
  const std::lock_guard lock(mutex_);
  std::vector<LiveStatus> result;
  for (const auto& [name, stream] : streams_) {
    result.push_back(stream->status());
    result.back().name = name;
  }
  return result;
}

void LiveHub::end_all() {
  const std::lock_guard lock(mutex_);
  ending_ = true;
  for (const auto& [name, stream] : streams_) stream->end();
}

LiveViewer::LiveViewer(std::shared_ptr<LiveStream> stream, LiveStream::Start start)
    : stream_(std::move(stream)),
      start_(std::move(start)),
      assembler_([this](std::span<const std::uint8_t> bytes) { return (*sink_)(bytes); }) {
  stream_->viewer_joined();
}

LiveViewer::~LiveViewer() {
  stream_->viewer_left();
}

LiveViewer::Step LiveViewer::step(const ByteSink& sink, std::chrono::milliseconds time) {
  sink_ = &sink;
  bool done = false;
  if (!write_next(time, done).ok()) return Step::kFailed;
  return done ? Step::kDone : Step::kGoOn;
}

Status LiveViewer::write_next(std::chrono::milliseconds time, bool& done) {
  if (assembler_.bytes() == 0) {
    if (Status status = assembler_.begin(start_.limits, start_.metadata); !status.ok()) return status;
    for (const SharedBytes& chunk : start_.data) {
      if (Status status = assembler_.write_data(*chunk); !status.ok()) return status;
    }
    return {};
  }
  LiveGop gop;
  const bool full = assembler_.gops() >= kMostGops;
  const LiveStream::Wait waited = full ? LiveStream::Wait::kEnded : stream_->next(wanted_, time, gop);
  if (waited == LiveStream::Wait::kNothingYet) return {};
  if (waited == LiveStream::Wait::kEnded) {
    done = true;
    return assembler_.end();
  }
  if (gop.mesh != mesh_ || gop.planes != planes_) {
    mesh_ = gop.mesh;
    planes_ = gop.planes;
    constexpr auto kAgain = StreamAssembler::Again::kLeaveOut;
    if (Status status = assembler_.write_mesh(*mesh_, kAgain); !status.ok()) return status;
    for (const SharedBytes& chunk : planes_) {
      if (Status status = assembler_.write_plan(*chunk, kAgain); !status.ok()) return status;
    }
  }
  wanted_ = gop.number + 1;
  return assembler_.write_gop(*gop.chunk, gop.frame_count);
}

}  // namespace tvg::server
