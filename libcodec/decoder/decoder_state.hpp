#pragma once
#include "container/chunk_reader.hpp"
#include "decoder/damage.hpp"
#include "modes/gop_decoder.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <tvg/decoder.hpp>

namespace tvg {

/// The decoding pipeline: bytes → structures → lattice → events. decoder.cpp has the arrows, damage.hpp what
/// becomes of losses, seek.cpp the way to a frame.
class Decoder::State {
 public:
  explicit State(const DecoderLimits& limits) : reader(limits) {}

  Event poll();
  void set_index(const std::vector<IndexEntry>& entries);
  Result<std::uint64_t> seek(std::uint64_t frame);
  std::uint64_t skip();

  // What the caller sees.
  ChunkReader reader;
  std::shared_ptr<const GopMesh> mesh = std::make_shared<const GopMesh>();  ///< that of the frames
  GopDecoder gop;
  GopInfo gop_info;
  std::uint64_t frame_number = 0;
  std::uint64_t frame_bytes = 0;
  Predictor frame_predictor = Predictor::kSpace;
  std::array<double, 3> frame_bits{};
  ChunkInfo chunk_info;
  Metadata metadata;
  Damage damage;
  std::vector<IndexEntry> index;
  /// Decodes a frame and fills frame_bits; null while nobody asks for bits.
  Status (GopDecoder::*measured_take)(Bytes, Predictor, std::array<double, 3>&) = nullptr;
  std::uint32_t most_components = kMaxComponents;  ///< of planes that are read from now on
  std::uint32_t lod = 0;                           ///< of meshes that are read from now on

 private:
  /// What the next structure of the stream yields; nothing where it is of no interest outside.
  std::optional<Event> step();
  Event take_chunk();
  std::optional<Event> take_mesh();
  std::optional<Event> take_plan();
  Result<PlanPart> decode_plan_read(const CodedMesh& coded, std::size_t part);
  std::shared_ptr<const PlanPart> plan_in_force(std::uint32_t id) const;
  std::shared_ptr<const BasisPlan> plan_of_gop() const;
  Status decode_mesh_read();
  std::shared_ptr<const GopMesh> mesh_in_force(std::uint32_t id) const;
  bool show(std::shared_ptr<const GopMesh> next);
  std::optional<Event> begin_gop();
  Event reject_gop(std::uint64_t missing, Error cause);
  std::optional<Event> lose_gop();
  void note_gop();
  std::optional<Event> decode_frame();
  std::optional<Event> end_gop();
  std::optional<Event> take_index();
  std::optional<Event> take_problem();
  Event end_stream();
  Event fail();

  Event doubt_gop(Error cause);
  Event tell(Damage what);
  /// Frames of the GOP being read that have not been decoded.
  std::uint64_t frames_left() const {
    return gop_end_ > frames_.position() ? gop_end_ - frames_.position() : 0;
  }

  void jump(const StreamMap::Place& place);
  const StreamMap::Place* next_stop() const;
  bool is_on_the_way(std::uint64_t missing) const;
  std::optional<Event> pass_gop(std::uint64_t missing);
  std::optional<Event> check_place();
  const StreamMap::Place* indexed_place() const;

  DamageLedger frames_;  ///< which are missing
  /// To be given out next, in this order.
  std::array<std::optional<Event>, 2> deferred_;
  std::uint64_t gop_end_ = 0;  ///< number of the frame behind the GOP being read; 0 outside
  StreamMap map_;
  std::uint64_t plans_made_ = 0;
  std::optional<std::uint64_t> target_;  ///< the frame sought: frames before it are not given out
  std::vector<std::uint64_t>
      needed_;  ///< where meshes and planes begin that the way there leads over, ascending
};

}  // namespace tvg
