#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tvg/encoder.hpp>
#include <tvg/geometry.hpp>
#include <tvg/join.hpp>
#include <tvg/source.hpp>
#include <tvg/types.hpp>

// One sequence, encoded in parts that know nothing of each other: on several machines, or one after the
// other. The parts are streams of their own, and join() (tvg/join.hpp) makes of them the bytes that encode()
// makes of the whole.
namespace tvg {

/// A run of frames of one mesh.
struct SourceStretch {
  std::uint64_t first_frame = 0;
  std::uint64_t frames = 0;
  std::uint32_t vertices = 0;
  std::uint64_t mesh_hash = 0;  ///< tells its mesh, with what that has beside faces, from others
  /// The frame that this mesh's reference shape is made of, in predictors that have one: its own first, or
  /// that of an earlier stretch whose mesh a decoder still knows.
  std::uint64_t shaped_by = 0;
};

/// What encoding a source in parts needs to know of all of it.
struct EncodePlan {
  std::uint64_t frames = 0;
  std::uint32_t frames_at_once =
      1;  ///< that are encoded together: those of a GOP or, in mode basis, a period
  /// Around all frames; absent where the encoding has no use for it.
  std::optional<BoundingBox> box;
  std::uint32_t vertices = 0;              ///< of the mesh that has most
  std::uint32_t faces = 0;                 ///< of the mesh that has most
  std::uint64_t property_bytes = 0;        ///< of the mesh that has most (property_bytes_of())
  std::uint64_t animated_frame_bytes = 0;  ///< of the mesh that has most (animated_frame_bytes_of())
  std::uint32_t meshes = 1;                ///< that a decoder keeps
  bool mesh_returns = false;               ///< a mesh comes again after another one
  std::vector<SourceStretch> stretches;    ///< all frames, in order
};

/// Looks at a source, as encode() with these options does: reads it once from its beginning to its end where
/// the box or the meshes to come are asked for, and leaves it at its first frame. kInvalidArgument where it
/// can be read only once, or does not know how long it is; otherwise fails as encode() does. `progress` is
/// told of frames read.
Result<EncodePlan> plan_encoding(FrameSource& source, const EncodeOptions& options,
                                 const EncodeProgress& progress = {});

/// Cuts a sequence into at most `parts` (at least 1) parts with about as many vertices, at the borders of
/// what is encoded together. There may be fewer: not one is empty.
std::vector<FrameRange> cut_into_parts(const EncodePlan& plan, std::uint32_t parts);

/// Encodes the frames of a part, which begins where such a cut can be, of a source that stands at its first
/// frame. Source and options are those of the plan, but for `threads`, on which nothing depends. Of what is
/// not in the part only frames are read from which something in it is made; others are passed over
/// (FrameSource::skip_frames()). The data "times" and "skeleton/positions" are those of the part. The report
/// is of the part. kInvalidArgument for a range that is no part, kInvalidInput where the source is not the
/// one that was planned, and as encode() does.
Result<EncodeReport> encode_part(FrameSource& source, const EncodeOptions& options, const EncodePlan& plan,
                                 const FrameRange& part, const ByteSink& sink,
                                 const EncodeProgress& progress = {});

/// What makes a stream known as a part of a whole: data of the name kPartData in it, of which join() knows
/// the order of parts and whether one is missing, and which it leaves out.
struct PartMark {
  std::string plan;          ///< names the plan: 1 to 64 letters and digits
  std::uint32_t number = 0;  ///< 1 to count
  std::uint32_t count = 0;

  bool operator==(const PartMark&) const = default;
};

inline constexpr const char* kPartData = "tvg/part";

/// The data that say so.
NamedData part_data(const PartMark& mark);
/// What such data say; nothing where they make no sense.
std::optional<PartMark> part_mark(const NamedData& data);

/// Reads a stream to its end, as join() does, and tells which part of a whole it is, if it is one. Fails
/// where the stream is not whole.
Result<std::optional<PartMark>> check_part(JoinInput stream);

}  // namespace tvg
