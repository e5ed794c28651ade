#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <tvg/geometry.hpp>
#include <tvg/levels.hpp>
#include <tvg/measure.hpp>
#include <tvg/properties.hpp>
#include <tvg/source.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// A bound of errors: a length in the mesh's units, or a share of the diagonal of the sequence's box, which
/// only encode() can know, from a source that can be read twice.
struct ErrorBound {
  double value = 0;
  bool of_diagonal = false;
};

/// How fine the values of attributes are whose bits are Attribute::kBitsOfKind, by their kind; 0: exact.
struct AttributeBits {
  int texcoord = 12;
  int normal = 10;  ///< of each of the two octahedral coordinates
  int colour = 8;
  int generic = Attribute::kExact;
};

struct EncodeOptions {
  /// kLossless leaves no choice of bits, step, importance or predictor: bits are those of float32 whatever
  /// these options say, but kInvalidArgument where they ask for two resolutions, a step, or a predictor other
  /// than kElp (the default) and kPyramid.
  Mode mode = Mode::kElp;
  int fine_bits = 11;    ///< B2, 1 to 24: bits of important vertices
  int coarse_bits = 11;  ///< B1, 1 to B2: bits of the others
  /// Instead of B2: edge of a fine cell in the mesh's units. All cells then lie on one grid, whatever the GOP
  /// or the stream: coarse cells begin at multiples of their edge, step * 2^(fine_bits - coarse_bits). Each
  /// GOP's B2 is what its own box needs, and B1 lies below it by fine_bits - coarse_bits.
  std::optional<double> step;
  Importance importance;  ///< of no effect when both lattices are the same
  Predictor predictor = Predictor::kElp;
  std::uint32_t gop_frames = 50;  ///< frames per GOP, at least 1
  /// In mode basis: frames that share a basis and are encoded together; 0 for what the effort says. encode()
  /// makes it no longer than the source, where it knows how long that is.
  std::uint32_t period_frames = 0;
  /// 1 (fast) to 9 (small): neighbours that the pyramid predicts from and, in mode basis, how many ways of
  /// quantizing are tried and how long periods are.
  int effort = 5;
  /// Instead of bits and step: what no coordinate may be off by more, but for the rounding of decoded
  /// positions to float32 (which encode() allows for where the source can be read twice). B2 and B1 must be
  /// the same.
  std::optional<ErrorBound> max_error;
  AttributeBits attribute_bits;
  bool keep_vertex_order = true;
  /// encode() alone: where each frame of the source has a mesh of its own, as captured volumes have, the
  /// order of vertices is given up, for it says nothing from frame to frame; and frames are coded by
  /// themselves (mode elp and, where there is one lattice and meshes are not tiny, each as its mesh's
  /// reference shape), unless they are to be lossless.
  bool suit_captured = false;
  /// Levels of the first mesh's vertices, and coarser meshes of it, at most 16, each with no more faces than
  /// the mesh. The pyramid is built from the levels; a coarser mesh can be played (Decoder::use_lod()), in
  /// mode basis from fewer bytes. kInvalidArgument where they do not fit the mesh. Null: none.
  std::shared_ptr<const MeshLevels> levels = {};
  std::uint64_t first_frame = 0;  ///< number of the source's first frame in a longer sequence it was cut from
  unsigned threads = 1;           ///< GOPs encoded at the same time; the bytes do not depend on it
  Metadata metadata;              ///< encode() adds what the source says
  /// Free-form data, whose names are unique and whose bytes are at most kMaxDataBytes each; compressed where
  /// that is smaller. encode() adds those of the source that have other names.
  std::vector<NamedData> data;

  /// What all frames lie in: every GOP then has the same lattice. Absent: each GOP has a box of its own, but
  /// encode() looks for that of the whole source where it can be read twice and no step is given.
  std::optional<BoundingBox> box;
  /// Bounds for the meshes to come, which the head declares; what the first mesh has where it has more.
  std::uint32_t max_vertices = 0;
  std::uint32_t max_faces = 0;
  std::uint32_t max_property_bytes = 0;  ///< of what meshes have beside connectivity (property_bytes_of())
  /// Of what the values of animated attributes may take of a frame (animated_frame_bytes_of()).
  std::uint32_t max_animated_frame_bytes = 0;
  /// How many meshes a decoder must keep, 1 to 65536: one of the last so many that comes again is not sent
  /// again.
  std::uint32_t max_meshes = 1;
};

/// What encoding made, in bytes.
struct EncodeReport {
  std::uint64_t frames = 0;
  std::uint32_t vertices = 0;  ///< of the first mesh
  std::uint64_t gops = 0;
  std::uint64_t meshes = 0;         ///< written; one that a decoder still knows is not written again
  std::uint64_t vertex_frames = 0;  ///< vertices, summed over frames
  bool captured = false;            ///< each frame has a mesh of its own, and that was made use of
  std::uint64_t bytes = 0;          ///< of the whole stream
  /// In mode basis: the largest error of a coordinate, in the mesh's units; 0 in others.
  double largest_error = 0;
  /// Polygons, of all meshes written, that come back as their triangles: those are no fan around the first
  /// corner, or are not next to each other where other faces share their edges.
  std::uint64_t polygons_left_out = 0;
  bool box_of_each_gop = false;  ///< neither box nor step was given, so each GOP has cells of its own
};

/// The encoder, pushed: set the mesh, add its frames, finish; the stream goes to a sink.
///
/// What is said here of a GOP is true of a period in mode basis, all of whose GOPs are encoded together.
///
/// A GOP is encoded as soon as its last frame is there and goes to the sink, in order, from the first call
/// after it is complete: with one thread from the call that completes it. The bytes do not depend on the
/// number of threads. Memory is in proportion to `threads` + 2 GOPs. Calls come from one thread at a time;
/// the sink and the progress are only called from within them, and what they throw passes through.
///
/// A call that fails with kWrongState (what comes out of turn), kInvalidArgument or kInvalidInput (what was
/// given cannot be encoded) or kLimitExceeded for a mesh changes nothing: others may follow. After any other
/// error the stream is lost, and every further call returns that error.
class Encoder {
 public:
  Encoder(EncodeOptions options, ByteSink sink, EncodeProgress progress = {});
  Encoder(Encoder&&) noexcept;
  Encoder& operator=(Encoder&&) noexcept;
  ~Encoder();

  /// The mesh of the frames that follow, and the joints that move it, if any; both are copied. The first call
  /// writes the head: kInvalidArgument where the options are out of range, or the importance asks for what
  /// this mesh and skeleton do not have. A later call ends the GOP and begins a new mesh: kLimitExceeded
  /// where that is larger than the head declares, kWrongState where the mesh before it has no frame yet.
  /// `properties` are what the mesh has beside its connectivity, copied as well: kInvalidInput where they do
  /// not fit it, or have values that are not finite.
  Status set_mesh(const Mesh& mesh, const Skeleton& skeleton = {}, const MeshProperties& properties = {});

  /// The next frame: positions [vertex][xyz] and, where the importance uses the skeleton, the joints
  /// [joint][xyz]. Both are copied. kInvalidArgument for a wrong size, and for a frame that makes its GOP's
  /// box larger than cells of the step of the options can fill; kInvalidInput for what is not finite or
  /// outside the box of the options.
  Status add_frame(std::span<const float> positions, std::span<const float> joints = {});
  /// The same where the mesh has animated attributes: `values` are those of each of its attributes in this
  /// frame, [attribute][value][component], copied too; what is not animated is not looked at. Of vertices and
  /// parts there are as many as those, of corners at least as many as `corners` name. kInvalidArgument where
  /// there are none, kInvalidInput where they are others or not finite.
  Status add_frame(std::span<const float> positions, std::span<const float> joints,
                   std::span<const std::span<const float>> values);

  /// Ends the stream. kInvalidInput where there was no frame. Nothing may follow.
  Result<EncodeReport> finish();

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// What properties count for against EncodeOptions::max_property_bytes and StreamLimits::property_bytes
/// (format-spec §5.7).
std::uint64_t property_bytes_of(const MeshProperties& properties, const Mesh& mesh);

/// What the values of animated attributes may take of a frame, against
/// EncodeOptions::max_animated_frame_bytes.
std::uint64_t animated_frame_bytes_of(const MeshProperties& properties, const Mesh& mesh);

/// Pushes a sequence through an encoder, mesh after mesh. Where the mesh does not change, and the options
/// have a box or a step and no largest error, or are lossless, the source is read once, from where it stands,
/// and not rewound. Otherwise a source that can be rewound is read twice, first for the bounding box of the
/// whole sequence and for the bounds of its meshes, which the head declares; it then says, too, how many
/// meshes a decoder keeps (at most 16), so that few are sent again. Of a source that can be read only once,
/// the options have to say what is ahead: kLimitExceeded where they do not. Errors: kInvalidArgument for
/// options out of range, kInvalidInput for geometry that cannot be encoded, and what source and sink return.
Result<EncodeReport> encode(FrameSource& source, const EncodeOptions& options, const ByteSink& sink,
                            const EncodeProgress& progress = {});

}  // namespace tvg
