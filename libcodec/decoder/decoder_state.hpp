#pragma once
#include "base/checksum.hpp"
#include "connectivity/mesh_coder.hpp"
#include "container/layout.hpp"
#include "container/stream_map.hpp"
#include "modes/gop_decoder.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tvg/decoder.hpp>

namespace tvg {

/// The decoding pipeline: bytes → chunks → packets → lattice. Each phase consumes a whole structure or asks
/// for more bytes; each call of step() yields at most one event.
class Decoder::State {
 public:
  explicit State(const DecoderLimits& limits) : caller_limits_(limits) {}

  void push(Bytes bytes) {
    if (phase_ == Phase::kFailed || phase_ == Phase::kEnded) return;
    if (begin_ > 0 &&
        begin_ >= buffer_.size() / 2) {  // keep what is unread at the front: no growth over time
      buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
      begin_ = 0;
    }
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  }

  void set_index(const std::vector<IndexEntry>& entries) { map_.set_index(entries); }
  Result<std::uint64_t> seek(std::uint64_t frame);
  std::uint64_t skip();

  Event poll() {
    if (deferred_) return *std::exchange(deferred_, std::nullopt);
    for (;;) {
      if (const std::optional<Event> event = step()) return *event;
    }
  }

  Event fail(Error cause) {
    phase_ = Phase::kFailed;
    error = std::move(cause);
    return Event::kError;
  }

  // What the caller sees.
  StreamHead head;
  Metadata metadata;
  CodedMesh mesh;
  GopDecoder gop;
  GopInfo gop_info;
  std::uint64_t frame_number = 0;
  std::uint64_t frame_bytes = 0;
  std::array<double, 3> frame_bits{};
  ChunkInfo chunk_info;
  Damage damage;
  Error error;
  std::vector<IndexEntry> index;
  bool input_finished = false;
  /// Decodes a frame and fills frame_bits; null while nobody asks for bits.
  Status (GopDecoder::*measured_take)(Bytes, std::array<double, 3>&) = nullptr;

 private:
  enum class Phase {
    kStart,
    kChunkHeader,
    kPayload,
    kSkip,
    kPacket,
    kGopChecksum,
    kResync,
    kTail,
    kEnded,
    kFailed
  };

  std::optional<Event> step();
  std::optional<Event> read_signature();
  std::optional<Event> read_chunk_start();
  std::optional<Event> read_payload();
  std::optional<Event> skip_payload();
  std::optional<Event> read_packet();
  std::uint64_t frames_passed_over(const GopHeader& header);
  std::optional<Event> begin_gop(Bytes packet, std::size_t total_bytes);
  std::optional<Event> decode_frame(Bytes packet, std::size_t total_bytes);
  std::optional<Event> end_gop();
  std::optional<Event> resynchronize();
  std::optional<Event> end_stream();

  std::optional<Event> use_head(Bytes payload);
  std::optional<Event> use_mesh(Bytes payload);
  std::optional<Event> use_index(Bytes payload);

  /// Goes on at the chunk at `new_offset`, before the frame with this number.
  void jump(std::uint64_t new_offset, std::uint64_t frame);
  std::optional<Event> pass_gop(std::uint32_t frame_count, std::uint64_t missing, std::size_t header_bytes);
  std::optional<Event> check_place(std::uint32_t frame_count);

  Bytes available() const { return Bytes(buffer_).subspan(begin_); }
  void consume(std::size_t count) {
    begin_ += count;
    offset_ += count;
  }
  std::optional<Event> need_bytes();
  Event truncated();
  std::uint64_t frames_left_in_gop() const;
  Event report_loss(std::uint64_t frames, Error cause);
  Event report_doubt(Error cause);
  std::optional<Event> lose_rest(Error cause, std::size_t passed = 1);
  std::optional<Event> lose_unproven(Error cause, std::size_t size);
  void begin_resync(std::size_t passed);

  DecoderLimits caller_limits_;
  Phase phase_ = Phase::kStart;
  std::optional<Event> deferred_;
  std::vector<std::uint8_t> buffer_;
  std::size_t begin_ = 0;     ///< first unread byte of the buffer
  std::uint64_t offset_ = 0;  ///< of that byte in the stream

  bool has_head_ = false;
  bool has_mesh_ = false;
  ChunkHeader chunk_{};
  std::uint64_t chunk_offset_ = 0;
  std::uint64_t payload_left_ = 0;  ///< bytes of the current GOP's or skipped chunk's payload still to come
  Hasher payload_hash_;
  std::uint32_t packet_index_ = 0;  ///< 0: header, 1 to frame_count: frames, then the digest
  std::uint32_t header_checksum_ = 0;
  std::uint64_t position_ = 0;            ///< number of the next frame
  std::uint64_t expected_label_ = 0;      ///< first_frame of the next GOP, if nothing was cut out
  std::optional<Error> unreported_loss_;  ///< damage of unknown extent: the next GOP or the index tells
  bool lost_anything_ = false;
  bool searched_ = false;                      ///< chunks may have been passed over since the last GOP
  std::uint64_t read_in_vain_ = 0;             ///< bytes of structures that did not fit their checksums
  std::optional<std::uint64_t> index_offset_;  ///< of the index chunk, once it was met
  StreamMap map_;
  std::uint64_t mesh_offset_ = 0;        ///< of the chunk of the mesh in force
  std::optional<std::uint64_t> target_;  ///< the frame sought: frames before it are not given out
  bool label_known_ = true;              ///< expected_label_ is that of the next GOP
};

}  // namespace tvg
