#include "player/playback/stream_loader.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>
#include <utility>

#include <tvg/normals.hpp>

// The decoding thread of the loader.
namespace tvg::player {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

void StreamLoader::run() {
  bool begun = false;
  for (;;) {
    const std::uint32_t strokes = work_->strokes();
    bool idle = false;
    {
      const std::lock_guard lock(mutex_);
      if (stopped_) return;
      idle = begun && find_work() == Work::kNone;
    }
    if (idle) {
      work_->wait_beyond(strokes);
      continue;
    }
    try {
      if (!std::exchange(begun, true)) go_to(0);
      go_on();
    } catch (const std::bad_alloc&) {
      pool_.drop_free();
      fail(Error{ErrorCode::kOutOfMemory, "there is not enough memory to decode it", {}, {}, ""});
    } catch (const std::exception& problem) {
      fail(Error{ErrorCode::kIo, problem.what(), {}, {}, ""});
    }
  }
}

/// Does the next of what there is to do.
void StreamLoader::go_on() {
  std::optional<Request> request;
  Work work = Work::kNone;
  {
    const std::lock_guard lock(mutex_);
    work = find_work();
    if (work == Work::kRequest) {
      request = std::exchange(request_, std::nullopt);
      input_->resume();
    }
  }
  switch (work) {
    case Work::kNone:
      break;
    case Work::kRequest:
      begin_request(*request);
      break;
    case Work::kLoop:
      begin_round(next_frame_);
      break;
    case Work::kDecode:
      take_index();
      advance();
      break;
  }
}

/// Called with the lock held.
StreamLoader::Work StreamLoader::find_work() const {
  if (request_) return Work::kRequest;
  if (!ring_.has_room() || !pool_.has_free()) return Work::kNone;
  if (active_) return Work::kDecode;
  const bool again = loop_ && state_.state == LoaderSnapshot::State::kEnded && pushed_in_round_ &&
                     !began_anew_ && input_->reaches(0);
  return again ? Work::kLoop : Work::kNone;
}

void StreamLoader::take_index() {
  const std::lock_guard lock(mutex_);
  if (!new_index_) return;
  entries_ = *std::exchange(new_index_, std::nullopt);
  decoder_->set_index(entries_);
}

void StreamLoader::begin_request(const Request& request) {
  wait_for_index(request.frame);
  take_index();
  std::uint64_t start = request.frame;
  {
    const std::lock_guard lock(mutex_);
    if (request_) return;
    const std::optional<std::uint64_t> count = facts_.frame_count();
    if (count && *count > 0) start = std::min(start, *count - 1);
    if (const GopMark* gop = facts_.gop_of(start)) {
      // All of them and the frame itself must fit the ring.
      const std::uint64_t lead_in = std::min<std::uint64_t>(request.lead_in, ring_.capacity() - 1);
      start -= std::min(lead_in, start - gop->first_frame);
    }
    ring_.reset(start);
    pushed_in_round_ = false;
  }
  go_to(start);
}

/// A frame that has not been met yet is reached by the index, if there is one, rather than by reading on.
void StreamLoader::wait_for_index(std::uint64_t frame) {
  if (!has_head_) return;
  for (;;) {
    const std::uint32_t strokes = work_->strokes();
    {
      const std::lock_guard lock(mutex_);
      wants_index_ = true;
      index_.notify_all();
      if (frame < facts_.known_end() || index_done_ || stopped_ || request_) return;
    }
    work_->wait_beyond(strokes);
  }
}

void StreamLoader::go_to(std::uint64_t frame) {
  target_.reset();
  if (!decoder_ || failed_) {
    decoder_ = std::make_unique<Decoder>(options_.limits);
    decoder_->measure_bits(options_.measure_bits);
    decoder_->use_lod(options_.lod);
    if (!entries_.empty()) decoder_->set_index(entries_);
    offset_ = 0;
    has_head_ = false;
    failed_ = false;
  }
  if (!has_head_) {
    if (frame > base_) target_ = frame;
    return;
  }
  const Result<std::uint64_t> offset = decoder_->seek(frame - std::min(frame, base_));
  if (!offset) {
    fail(offset.error());
    return;
  }
  offset_ = *offset;
  next_frame_ = frame;
}

void StreamLoader::advance() {
  const Clock::time_point start = Clock::now();
  switch (decoder_->poll()) {
    case Decoder::Event::kNeedBytes:
      feed();
      break;
    case Decoder::Event::kHead:
      has_head_ = true;
      if (target_) begin_request({*target_, 0});
      break;
    case Decoder::Event::kMetadata: {
      const std::lock_guard lock(mutex_);
      state_.metadata = decoder_->metadata();
      break;
    }
    case Decoder::Event::kMesh:
      begin_mesh();
      break;
    case Decoder::Event::kGop:
      begin_gop();
      break;
    case Decoder::Event::kFrame:
      take_frame(milliseconds_since(start));
      break;
    case Decoder::Event::kDamage:
      note_damage();
      break;
    case Decoder::Event::kEnd:
      end_stream();
      break;
    case Decoder::Event::kError:
      fail(decoder_->error());
      break;
    case Decoder::Event::kData:
      take_data();
      break;
    case Decoder::Event::kChunk:
      break;
  }
}

void StreamLoader::feed() {
  if (const std::uint64_t passed = decoder_->skip(); passed > 0) {
    offset_ += passed;
    return;  // at the end of a chunk there may be more to pass
  }
  const Result<std::size_t> count = input_->read(offset_, piece_);
  if (!count) {
    {
      const std::lock_guard lock(mutex_);
      if (stopped_ || request_) return;
    }
    constexpr int kMostInVain = 5;
    if (openings_in_vain_++ < kMostInVain && input_->begin_anew()) {
      begin_live_anew();
    } else {
      fail(count.error());
    }
    return;
  }
  if (*count == 0) {
    decoder_->finish();
    return;
  }
  decoder_->push(std::span(piece_).first(*count));
  offset_ += *count;
  const std::lock_guard lock(mutex_);
  state_.bytes_read += *count;
}

/// The frames of a live stream that is opened again follow those that came before.
void StreamLoader::begin_live_anew() {
  {
    const std::lock_guard lock(mutex_);
    began_anew_ = true;
  }
  base_ = next_frame_;
  decoder_.reset();
  go_to(base_);
}

void StreamLoader::begin_gop() {
  auto gop = std::make_shared<PlayerGop>();
  gop->info = decoder_->gop();
  gop->info.first_frame += base_;
  gop->flags.resize(decoder_->mesh().vertex_count);
  decoder_->copy_flags(gop->flags);
  gop->keeps_vertex_order = decoder_->mesh_info().keeps_vertex_order;
  used_decorator_.reset();
  const std::lock_guard lock(mutex_);
  facts_.note_gop({gop->info.first_frame, gop->info.frame_count, decoder_->chunk().offset, gop->info.bytes});
  gop_ = std::move(gop);
}

void StreamLoader::take_frame(double decode_ms) {
  const std::uint64_t number = base_ + decoder_->frame_number();
  std::optional<std::uint64_t> last;
  {
    const std::lock_guard lock(mutex_);
    if (request_) return;
    if (loop_) last = loop_->last;
  }
  next_frame_ = number + 1;
  if (!last || number <= *last) {
    std::shared_ptr<PlayerFrame> frame = pool_.take();
    frame->number = number;
    fill_frame(*frame, decode_ms);
    push_frame(std::move(frame));
  }
  if (last && number >= *last && pushed_in_round_) begin_round(*last + 1);
}

void StreamLoader::fill_frame(PlayerFrame& frame, double decode_ms) {
  const Clock::time_point start = Clock::now();
  std::shared_ptr<FrameDecorator> decorator;
  {
    const std::lock_guard lock(mutex_);
    frame.mesh = state_.mesh;
    frame.surface = surface_;
    decorator = decorator_;
  }
  const std::size_t count = 3 * std::size_t{frame.mesh->vertex_count};
  frame.gop = gop_;
  frame.positions.resize(count);
  decoder_->copy_positions(frame.positions.data());
  frame.colours.clear();
  if (frame.surface != nullptr && frame.surface->frame_colours) {
    const std::span<const float> colours = decoder_->animated_values(frame.surface->frame_colours->attribute);
    frame.colours.assign(colours.begin(), colours.end());
  }
  frame.decode_ms = decode_ms + milliseconds_since(start);
  const Clock::time_point decoded = Clock::now();
  frame.normals.resize(count);
  vertex_normals(frame.mesh->faces, frame.positions, frame.normals);
  frame.packet_bytes = decoder_->frame_bytes();
  frame.bits = options_.measure_bits ? decoder_->frame_bits() : std::array<double, 3>{};
  frame.is_keyframe = frame.number == gop_->info.first_frame;
  frame.values.clear();
  if (decorator) {
    if (used_decorator_ != decorator) decorator->on_gop(*frame.mesh, *gop_);
    decorator->on_frame(frame);
  }
  used_decorator_ = std::move(decorator);
  frame.prepare_ms = milliseconds_since(decoded);
}

void StreamLoader::push_frame(std::shared_ptr<PlayerFrame> frame) {
  const std::lock_guard lock(mutex_);
  constexpr double kNewShare = 0.05;
  const double decode_ms = frame->decode_ms;
  ++state_.frames_decoded;
  state_.mean_decode_ms += (state_.frames_decoded == 1 ? 1 : kNewShare) * (decode_ms - state_.mean_decode_ms);
  state_.max_decode_ms = std::max(state_.max_decode_ms, decode_ms);
  state_.frame_slots = pool_.size();
  facts_.note_frame(frame->number, frame->packet_bytes);
  if (request_) return;
  if (!opened_) {
    opened_ = true;
    state_.state = LoaderSnapshot::State::kReady;
  }
  ring_.push(std::move(frame));
  openings_in_vain_ = 0;
  pushed_in_round_ = true;
  if (!wants_index_) {
    wants_index_ = true;
    index_.notify_all();
  }
}

void StreamLoader::note_damage() {
  const Damage& damage = decoder_->damage();
  const std::uint64_t first = base_ + damage.first_frame;
  const std::lock_guard lock(mutex_);
  facts_.note_damage(damage, first);
  if (first < next_frame_ && damage.error.code == ErrorCode::kDigestMismatch) return;
  next_frame_ = std::max(next_frame_, first + damage.frame_count);
  if (!request_) ring_.pass_over(first, damage.frame_count);
}

/// The round that ends before frame `end` is decoded: the next one follows at once.
void StreamLoader::begin_round(std::uint64_t end) {
  std::uint64_t first = 0;
  {
    const std::lock_guard lock(mutex_);
    if (request_ || !loop_) return;
    first = loop_->first;
    ring_.close(end, first);
    active_ = true;
    state_.state = LoaderSnapshot::State::kReady;
    pushed_in_round_ = false;
  }
  go_to(first);
}

void StreamLoader::end_stream() {
  {
    const std::lock_guard lock(mutex_);
    facts_.note_end(next_frame_);
    if (request_) return;
    const bool again = loop_ && pushed_in_round_ && !began_anew_ && input_->reaches(0);
    if (!again) {
      ring_.close(next_frame_, next_frame_);
      active_ = false;
      state_.state = LoaderSnapshot::State::kEnded;
      return;
    }
  }
  begin_round(next_frame_);
}

void StreamLoader::fail(const Error& error) {
  failed_ = true;
  const std::lock_guard lock(mutex_);
  if (request_) return;
  ring_.close(next_frame_, next_frame_);
  active_ = false;
  state_.state = LoaderSnapshot::State::kFailed;
  const bool names_input = error.message.starts_with(input_->name());
  state_.message = names_input ? error.message : input_->name() + ": " + error.describe();
}

}  // namespace tvg::player
