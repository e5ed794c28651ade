#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tvg/data.hpp>
#include <tvg/properties.hpp>
#include <tvg/stream_map.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// A run of frames that could not be decoded, or, with kDigestMismatch, frames that were given out but are
/// not what was encoded.
struct Damage {
  std::uint64_t first_frame = 0;  ///< position in the stream of the first frame lost
  std::uint64_t frame_count = 0;  ///< frames lost; 0 where something is wrong by which none is lost
  bool count_known = true;  ///< false: frames may be lost, nobody can know how many, and frame_count is 0
  Error error;
};

/// The importance and resolution of the GOP being decoded.
struct GopInfo {
  std::uint64_t first_frame = 0;   ///< position in the stream
  std::uint64_t source_frame = 0;  ///< number of its first frame in the sequence that was encoded
  std::uint32_t frame_count = 0;
  Mode mode = Mode::kElp;
  std::array<bool, kPredictorCount> predictors{};  ///< [Predictor]: whether frames may have it
  std::uint32_t components = 0;                    ///< of the basis; 0 in other modes
  int fine_bits = 0;                               ///< B2; 32 in mode lossless
  int coarse_bits = 0;                             ///< B1; 32 in mode lossless
  std::array<double, 3> origin{};
  /// Of the fine lattice, in the mesh's units; 0 in mode lossless. In mode basis that of its sums, which does
  /// not bound their errors.
  double step = 0;
  std::uint32_t flagged = 0;       ///< number of important vertices; all of them when the bits are equal
  std::uint64_t bytes = 0;         ///< of the whole chunk
  std::uint64_t header_bytes = 0;  ///< of the header packet without the flags
  std::uint64_t flag_bytes = 0;
};

/// The planes that the frames of a GOP in mode basis are sums of. A plane has a coefficient for each vertex.
struct BasisInfo {
  std::uint64_t number = 0;      ///< of the planes, from 1: those of the same number are the same
  std::uint32_t components = 0;  ///< planes that are decoded (Decoder::use_components())
  std::int32_t most = 0;         ///< no coefficient is larger in size; at most 2^24
};

/// A chunk as it stands in the stream.
struct ChunkInfo {
  std::string type;          ///< four characters
  std::uint64_t offset = 0;  ///< of its first byte
  std::uint64_t bytes = 0;   ///< of header, payload and checksum
};

/// A coarser mesh over some of a mesh's vertices.
struct LodInfo {
  std::uint32_t levels = 0;  ///< it has the vertices of levels below
  std::uint32_t vertices = 0;
  std::uint32_t faces = 0;
  std::uint64_t bytes = 0;  ///< of its coded parts
};

/// What the coded parts of the current mesh take.
struct MeshInfo {
  std::uint64_t connectivity_bytes = 0;
  std::uint64_t order_bytes = 0;
  std::uint64_t shape_bytes = 0;   ///< of the reference shape
  bool keeps_vertex_order = true;  ///< frames come in the order of the encoder's input
  std::uint64_t levels_bytes = 0;  ///< of the levels of vertices
  std::uint64_t lods_bytes = 0;    ///< of the coarser meshes
  std::uint32_t levels = 0;        ///< that the vertices have; 0 where none were transmitted
  std::vector<LodInfo> lods = {};  ///< the finest first
  std::uint32_t lod = 0;           ///< which of them mesh() is, counted from 1; 0: the whole mesh
  std::uint64_t parts_bytes = 0;
  std::uint64_t attributes_bytes = 0;  ///< of those that are not animated
  std::uint64_t polygons_bytes = 0;
};

/// Decodes a stream as its bytes arrive. Bytes go in with push(), in pieces of any size; poll() then says
/// what they yield, one event at a time:
///
///   tvg::Decoder decoder;
///   for (;;) {
///     switch (decoder.poll()) {
///       case Event::kNeedBytes: push() the next piece, or finish() when there is none; break;
///       case Event::kFrame: decoder.copy_positions(...); break;
///       case Event::kDamage: frames are missing: decoder.damage() says which and why; decoding goes on;
///       break; case Event::kEnd: return; case Event::kError: the stream cannot be decoded any further:
///       decoder.error(); return;
///       ...
///     }
///   }
///
/// The decoder never throws, never reads outside what it was given, and holds at most what the stream's head
/// declares.
class Decoder {
 public:
  enum class Event {
    kNeedBytes,  ///< nothing more to say until push() or finish()
    kChunk,      ///< a chunk begins: chunk()
    kHead,       ///< head() is valid
    kMetadata,   ///< metadata() is valid
    kData,       ///< free-form data: data()
    kMesh,       ///< mesh() is another; frames that follow belong to it
    kGop,        ///< gop() is valid
    kFrame,      ///< a frame is decoded: frame_number(), copy_positions()
    kDamage,     ///< frames are missing, or something else is wrong: damage(); decoding goes on
    kEnd,        ///< the stream is complete
    kError,      ///< error() says why decoding cannot go on
  };

  explicit Decoder(const DecoderLimits& limits = {});
  ~Decoder();
  Decoder(Decoder&&) noexcept;
  Decoder& operator=(Decoder&&) noexcept;

  /// Takes the next bytes of the stream; they are copied.
  void push(std::span<const std::uint8_t> bytes);
  /// Says that no bytes follow.
  void finish();
  /// Tells where meshes and GOPs lie (parse_index()), so that seek() can go anywhere at once.
  void set_index(const std::vector<IndexEntry>& entries);
  /// Goes to `frame`: the next kFrame is this one or, where it is lost, the first good one after it. Returns
  /// the offset in the stream at which the bytes pushed from now on begin. Without an index a frame beyond
  /// those met so far is reached by reading on; GOPs in between are passed over, not decoded.
  /// kInvalidArgument where the index says that there is no such frame, or before kHead.
  Result<std::uint64_t> seek(std::uint64_t frame);
  /// The number of bytes that come next in the input and are of no use on the way to the frame sought, or for
  /// the mesh that use_lod() asks for; they count as pushed, so that the next push() begins behind them. A
  /// caller that reads from a pipe need not ask.
  std::uint64_t skip();
  /// Of the planes that GOPs in mode basis share and that are read from now on, decode only the first `most`
  /// (a multiple of four, or rounded up to one): the others count as 0, which gives coarser frames sooner.
  /// Planes are ordered by what they add. Those left out go without a check by their digest; the rows of
  /// frames are checked as ever. Other modes have no components. All are decoded unless this says otherwise.
  void use_components(std::uint32_t most);
  /// Draws meshes that are read from now on as one of the coarser meshes that they have: 1 the first coarser
  /// one, and so on, whatever is above the last as the last; 0, as at first, the whole mesh. What is said of
  /// vertices below is then said of that mesh's. In mode basis fewer bytes are needed for it: skip() leaves
  /// out the others, and that they are damaged loses no frame. Other modes decode all.
  void use_lod(std::uint32_t lod);
  /// Whether frame_bits() is measured; it takes time.
  void measure_bits(bool on);
  /// The next event. After kEnd and kError it is the same until seek().
  Event poll();

  const StreamHead& head() const;
  const Metadata& metadata() const;
  /// Free-form data as they stand in the stream, whatever they are (unpack_data()); valid after kData until
  /// the next poll() or push(). Data of a name that came before take the place of those.
  const CodedData& data() const;
  /// Connectivity in the order frames are given in: the input's own unless the stream gave that up. Of a
  /// coarser mesh (use_lod()) the vertices are some of the whole mesh's, in the same order.
  const Mesh& mesh() const;
  const MeshInfo& mesh_info() const;
  /// What mesh() has beside its connectivity, in terms of its vertices and faces: a value of a corner is
  /// there once for the faces around a vertex that share it, and `bits` are those that were used. Of animated
  /// attributes the values are 0: animated_values() has them. Empty where there is nothing, and for a coarser
  /// mesh (use_lod()).
  const MeshProperties& properties() const;
  /// Coarser meshes that the current mesh has.
  std::uint32_t lod_count() const;
  /// [vertex of mesh()]: its number in the whole mesh, ascending; empty where mesh() is the whole.
  std::span<const std::uint32_t> lod_vertices() const;
  const ChunkInfo& chunk() const;
  const GopInfo& gop() const;

  /// Position of the current frame in the stream, counted from 0; frames that were lost count.
  std::uint64_t frame_number() const;
  /// What the current frame was predicted from.
  Predictor frame_predictor() const;
  /// Bytes of the current frame's packet with its kind, size and checksum.
  std::uint64_t frame_bytes() const;
  /// Bits that the residuals of x, y and z take in the current frame's packet, after measure_bits(true).
  const std::array<double, 3>& frame_bits() const;
  /// Writes the current frame: vertex v's x, y, z as float32 at `positions` + v * `stride` bytes (at least
  /// 12). The caller owns the buffer of vertex_count * stride bytes.
  void copy_positions(void* positions, std::size_t stride = 12) const;
  /// Writes the current frame's lattice indices, [vertex][xyz], each on its vertex's own lattice; in mode
  /// lossless the bits of each float32 coordinate as an integer in the order of the numbers: the bits, or for
  /// a set sign -1 less the other bits. 3 * vertex_count values.
  void copy_lattice(std::span<std::int32_t> indices) const;
  /// The values of an animated attribute, by its place in properties(), in the current frame,
  /// [value][component]; empty for one that is not animated. Valid until the next poll().
  std::span<const float> animated_values(std::size_t attribute) const;
  /// Bytes that they take of the current frame's packet.
  std::uint64_t animated_bytes(std::size_t attribute) const;
  /// Importance of each vertex in the current GOP, 0 or 1. vertex_count values.
  void copy_flags(std::span<std::uint8_t> flags) const;

  /// For who has a GPU make the sums: the planes of the current GOP, number 0 where it is in another mode.
  /// Frames are not made before copy_positions(), so that a reader that takes their rows instead saves the
  /// time; the digest of mode basis is over the rows and is compared all the same.
  BasisInfo basis() const;
  /// Writes coefficients of the current GOP, whole numbers: of components 4 * `group` to 4 * `group` + 3,
  /// [vertex][4], 0 for those there are none of. 4 * vertex_count values; basis().most must fit them.
  void copy_planes(std::size_t group, std::span<float> values) const;
  void copy_planes(std::size_t group, std::span<std::int16_t> values) const;
  /// Writes what the current frame multiplies the planes by, [1 + component][xyz], in the mesh's units:
  /// vertex v is at rows[0] + the sum of all coefficients of v times the row of their component. 3 * (1 +
  /// components) values.
  void copy_rows(std::span<float> rows) const;

  const Damage& damage() const;
  const Error& error() const;
  /// The stream's own index once kEnd was reached; empty when it had none.
  const std::vector<IndexEntry>& index() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace tvg
