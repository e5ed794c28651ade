#pragma once
#include "base/checksum.hpp"
#include "base/stream_error.hpp"
#include "container/chunk.hpp"
#include "container/chunk_order.hpp"
#include "container/chunk_window.hpp"
#include "container/gop_header.hpp"
#include "container/index.hpp"
#include "container/mesh_payload.hpp"
#include "container/packet.hpp"
#include "container/plan_payload.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <tvg/data.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// Takes a stream apart as its bytes arrive: the one reader of its structure (format-spec §3, §4, §8.3). It
/// knows which chunk may stand where, how long each may be, and what the checksums say; what packets and
/// meshes decode to it does not know.
///
/// After damage it looks for the next chunk by itself. It holds the bytes of one structure that is not
/// complete yet: a packet, or a payload whose length has a bound. It never throws.
class ChunkReader {
 public:
  enum class Event {
    kNeedBytes,
    kChunk,     ///< a chunk begins: chunk(), chunk_offset()
    kHead,      ///< head()
    kMetadata,  ///< metadata()
    kData,      ///< data()
    kMesh,      ///< a mesh with counts that the head allows: mesh(), mesh_id(), content() is the payload
    kPlan,      ///< planes of a mesh that can be used, in a known mode: plan(), plan_id(), content()
    kGop,       ///< a GOP whose mesh and planes are in force, in a known mode: gop(), content() is the header
    kGopLost,   ///< the same, but it cannot be decoded: gop(), problem(); the GOP is passed over
    kFrame,     ///< content() is a frame's packet, predictor()
    kDigest,    ///< content() is the digest of the GOP
    kPacket,    ///< a packet of the GOP that may be skipped
    kGopEnd,    ///< all checksums of the GOP fit
    kIndex,     ///< take_index(), index_matches()
    kProblem,   ///< problem()
    kEnd,       ///< the tail was read, and nothing follows
    kFailed,    ///< error() says why nothing more can be read
  };

  /// Something is wrong, and reading goes on.
  struct Problem {
    Error error;
    bool loses = false;      ///< what was being read cannot be used: the rest of a GOP, or some chunk
    bool searching = false;  ///< chunks that follow may be passed over unseen
    bool doubts = false;     ///< the frames of the GOP that were given out are in doubt, too
  };

  explicit ChunkReader(const DecoderLimits& limits) : caller_limits_(limits) {}

  /// Takes the next bytes; they are copied. False where there is no memory for them: the reader has failed.
  bool push(Bytes bytes);
  /// Says that no bytes follow.
  void finish() { finished_ = true; }
  /// The next event. What it names is valid until the next call of push() or next().
  Event next();

  /// Keeps what was made of the mesh or the planes given out last as long as they are in force.
  void keep(std::shared_ptr<const void> content) {
    window_of(kind_).find(payload_checksum_)->content = std::move(content);
  }
  /// Of the mesh given out last only so many parts of planes are wanted: those that add to as many others are
  /// passed over, and GOPs need not have them.
  void want_parts(std::uint32_t count) {
    meshes_.find(payload_checksum_)->parts_wanted = count;
    leaves_out_ = true;
  }
  /// The content given out last cannot be used though its checksum fits. Of a GOP the rest is passed over;
  /// what is malformed may be damage by chance, so that the next chunk is looked for. A mesh or planes stay
  /// in force as what cannot be used.
  void reject(ErrorCode why);
  /// Passes over the rest of the current GOP unread.
  void pass_over();
  /// Whether planes are being passed over that are not wanted.
  bool passes_unwanted() const { return phase_ == Phase::kPassOver && unwanted_; }
  /// While a chunk is passed over: how many of the bytes that come next in the input belong to it. They
  /// count as pushed.
  std::uint64_t skip();
  /// Goes on at the chunk at this place, whatever was read before; of the meshes and planes in force those
  /// stay whose chunks begin at one of these places. The head must have been read.
  void jump(std::uint64_t new_offset, std::span<const std::uint64_t> kept);
  /// Ends reading with this error.
  Event fail(Error error);

  const StreamHead& head() const { return head_; }
  /// Hands out what kMetadata tells of; empty from then on.
  Metadata take_metadata() { return std::exchange(metadata_, {}); }
  /// Name and bytes lie in those given out: they are valid no longer than content().
  const CodedData& data() const { return data_; }
  std::uint32_t data_id() const { return payload_checksum_; }
  /// Its parts lie in the bytes given out: they are valid no longer than content().
  const MeshLayout& mesh() const { return mesh_; }
  std::uint32_t mesh_id() const { return payload_checksum_; }
  /// Meshes in force; `number` is how many vertices each has.
  const ChunkWindow& meshes() const { return meshes_; }
  /// Its parts are valid no longer than content().
  const PlanHeader& plan() const { return plan_; }
  std::uint32_t plan_id() const { return payload_checksum_; }
  /// Chunks of planes in force, beside some whose meshes came again since (§4.9).
  const ChunkWindow& plans() const { return plans_; }
  /// Its parts are valid no longer than content().
  const GopHeader& gop() const { return gop_; }
  Predictor predictor() const { return predictor_; }
  Bytes content() const { return content_; }
  /// The bytes of the structure given out last as they stand in the stream: of kChunk the chunk's header, of
  /// the others all from the end of the structure before. A chunk is the sum of its structures.
  Bytes raw() const { return available().first(used_); }
  /// Hands out what kIndex tells of; empty from then on.
  std::vector<IndexEntry> take_index() { return std::exchange(index_, {}); }
  /// False when the index names other chunks than were met; true also when that cannot be known.
  bool index_matches() const { return index_matches_; }
  const ChunkHeader& chunk() const { return chunk_; }
  std::uint64_t chunk_offset() const { return chunk_offset_; }
  Problem& problem() { return problem_; }
  Error& error() { return error_; }

  bool has_head() const { return state_ != StreamState::kStart; }
  StreamState state() const { return state_; }
  /// Of the structure given out last, or the first byte not read.
  std::uint64_t offset() const { return offset_; }
  /// Of the first byte not pushed.
  std::uint64_t input_offset() const { return offset_ + available().size(); }
  /// Whether a chunk is next.
  bool at_chunk() const { return phase_ == Phase::kChunkHeader; }
  bool over() const { return phase_ == Phase::kFailed || phase_ == Phase::kEnded; }

 private:
  enum class Phase {
    kStart,
    kChunkHeader,
    kPlanes,    ///< a payload of planes, of which the header tells whether they are wanted
    kPayload,   ///< a payload that is used whole
    kPassOver,  ///< one that is not used
    kPacket,
    kGopChecksum,
    kSearch,
    kTail,
    kEnded,
    kFailed,
  };

  std::optional<Event> step();
  std::optional<Event> read_signature();
  std::optional<Event> read_header();
  OrderRule rule_for(const ChunkHeader& header, ChunkKind kind) const;
  Event refuse_header(const ChunkHeader& header, ChunkKind kind, const OrderRule& rule);
  Event use_header(const ChunkHeader& header, ChunkKind kind, OrderRule::Verdict verdict);
  std::optional<Event> look_at_planes();
  std::optional<Event> read_payload();
  std::optional<Event> use_payload(Bytes payload);
  Event use_head(Bytes payload);
  std::optional<Event> use_mesh(Bytes payload);
  std::optional<Event> use_plan(Bytes payload);
  Event use_index(Bytes payload);
  std::optional<Event> use_tail(Bytes payload);
  std::optional<Event> pass_payload();
  std::optional<Event> end_payload();
  std::optional<Event> next_packet();
  Event use_packet(const PacketRead& packet);
  Event use_gop_header();
  Fault find_planes(const ChunkWindow::Entry& mesh, PlaneList& back);
  Fault check_planes(const ChunkWindow::Entry& mesh) const;
  bool note_mesh(std::uint32_t vertex_count, std::optional<ErrorCode> fault);
  bool note_plan(std::uint64_t owner, std::optional<ErrorCode> fault);
  const ChunkWindow::Entry* base_of_planes(const ChunkWindow::Entry& mesh) const;
  Event misplaced(const char* sentence);
  Event lose_gop(const Fault& fault);
  std::optional<Event> end_packets();
  std::optional<Event> end_gop();
  std::optional<Event> search();
  Event end_stream();

  void enter_state(const ChunkHeader& header, ChunkKind kind);
  std::uint64_t most_payload(ChunkKind kind) const;
  ChunkWindow& window_of(ChunkKind kind) { return kind == ChunkKind::kPlan ? plans_ : meshes_; }
  bool reserve_for_packets();
  std::optional<Event> need_bytes();
  Event tell(Event event, Error error, std::uint64_t offset, bool loses, bool searching);
  Event report(Error error);
  Event lose(Error error, std::size_t passed);
  Event lose_unproven(Error error, std::size_t size);
  bool in_sequence() const { return state_ == StreamState::kOpen || state_ == StreamState::kBody; }
  void begin_search(std::size_t passed);

  Bytes available() const { return Bytes(buffer_).subspan(begin_); }
  void consume(std::size_t count) {
    begin_ += count;
    offset_ += count;
  }

  DecoderLimits caller_limits_;
  Phase phase_ = Phase::kStart;
  StreamState state_ = StreamState::kStart;
  std::vector<std::uint8_t> buffer_;
  std::size_t begin_ = 0;     ///< first byte of the buffer not read
  std::size_t used_ = 0;      ///< bytes from there on of the structure given out last
  std::uint64_t offset_ = 0;  ///< in the stream, of byte begin_
  bool finished_ = false;

  StreamHead head_;
  Metadata metadata_;
  CodedData data_;
  ChunkHeader chunk_{};
  ChunkKind kind_ = ChunkKind::kHead;
  std::uint64_t chunk_offset_ = 0;
  std::uint64_t payload_left_ = 0;  ///< bytes of the payload not read, where it is read in pieces
  Hasher payload_hash_;
  bool hashed_ = true;  ///< the payload is to be compared with its checksum
  Bytes content_;

  std::uint32_t payload_checksum_ = 0;  ///< of the payload used last
  MeshLayout mesh_{};
  ChunkWindow meshes_;
  bool leaves_out_ = false;  ///< of some mesh not all parts of planes are wanted
  PlanHeader plan_;
  bool unwanted_ = false;  ///< the planes being passed over are
  ChunkWindow plans_;      ///< `number` is owner_of_planes(); 0 where their header could not be read

  GopHeader gop_;
  Predictor predictor_ = Predictor::kSpace;
  std::uint32_t packet_number_ = 0;    ///< of the next packet: 0 the header
  std::uint32_t frames_met_ = 0;       ///< of the GOP
  bool digest_met_ = false;            ///< of the GOP
  std::uint32_t header_checksum_ = 0;  ///< of the header packet

  IndexDigest expected_index_;  ///< of the chunks met
  std::vector<IndexEntry> index_;
  bool index_matches_ = true;
  std::optional<std::uint64_t> index_offset_;

  std::optional<std::uint64_t> reported_at_;  ///< where a chunk stands that was said to be out of place

  bool whole_ = true;               ///< all from the first byte on was read and nothing of it lost
  std::uint64_t read_in_vain_ = 0;  ///< bytes of structures that did not fit their checksums
  Problem problem_;
  Error error_;
};

}  // namespace tvg
