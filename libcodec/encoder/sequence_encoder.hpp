#pragma once
#include "container/stream_writer.hpp"
#include "encoder/gop_queue.hpp"
#include "source/gop_cutter.hpp"

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <tvg/encoder.hpp>

namespace tvg {

/// What happened to a mesh before the frames of a part of a sequence, so that the part has the bytes that the
/// whole would have.
struct MeshPast {
  /// The frame of the whole sequence whose positions the mesh's reference shape is made of; frames so shaped
  /// have one mesh chunk.
  std::uint64_t shaped_by = 0;
  /// The positions of that frame, [vertex][xyz]; empty where it is the first that is added.
  std::span<const float> shape;
  std::uint64_t first_frame = 0;    ///< of the frames of this mesh in the whole sequence
  std::uint64_t frames_before = 0;  ///< those of them that come before the part: whole GOPs or periods
  /// The last GOP of these where the importance looks back (Importance::low_delay), else null.
  std::shared_ptr<const GopFrames> gop_before = {};
};

/// Encoder (tvg/encoder.hpp), which takes a whole sequence or, told what came before, a part of one.
class SequenceEncoder {
 public:
  SequenceEncoder(EncodeOptions options, ByteSink sink, EncodeProgress progress);

  /// As Encoder does, whose checks and errors are these.
  Status set_mesh(const Mesh& mesh, const Skeleton& skeleton, const MeshProperties& properties);
  Status add_frame(std::span<const float> positions, std::span<const float> joints,
                   std::span<const std::span<const float>> values);
  Result<EncodeReport> finish();

  /// A mesh of a part, of which the whole tells what came before; all meshes of a stream are set in one way
  /// or all in the other.
  Status set_mesh(const Mesh& mesh, const Skeleton& skeleton, const MeshProperties& properties,
                  const MeshPast& past);

 private:
  struct Stretch;
  struct Job;

  static Result<EncodedRun> mark_and_encode(const Job& job);

  Status check_open() const;
  Status check_new_mesh(const Mesh& mesh, const Skeleton& skeleton, const MeshProperties& properties,
                        bool leads) const;
  Status check_new_frame(std::span<const float> positions, std::span<const float> joints,
                         const BoundingBox& frame_box) const;
  /// Does what cannot be taken back: an error stays.
  template <class Work>
  Status lasting(Work work);

  /// Frames of the sequence up to the next one, those before a part among them.
  std::uint64_t frames_added() const { return frames_before_ + (cutter_ ? cutter_->frames() : 0); }
  Status write_start(const Stretch& first);
  /// Ends the stretch before it and goes on with this one, whose mesh is written or waits for its shape.
  Status begin_stretch(std::shared_ptr<Stretch> stretch, bool is_known, GopCutter cutter);
  /// The stretch of the same mesh and joints whose mesh a decoder still knows; null where there is none.
  std::shared_ptr<Stretch> in_force(const Mesh& mesh, const Skeleton& skeleton,
                                    const MeshProperties& properties) const;
  std::shared_ptr<Stretch> in_force(std::uint64_t shaped_by) const;
  /// With a reference shape it is written with the first frame, which the shape is made of.
  Status write_mesh(std::span<const float> first_frame);
  Status enqueue(GopContent gop);
  Status flush();
  Status write_what_is_done();
  Status write(std::optional<Result<EncodedRun>> done);
  Result<Lattice> lattice_for(const BoundingBox& box) const;

  const std::shared_ptr<const EncodeOptions> options_;
  EncodeProgress progress_;
  StreamWriter writer_;
  GopQueue queue_;
  const bool with_joints_;
  StreamLimits limits_;
  std::uint64_t frame_bytes_ = 0;  ///< that the limits have for the animated attributes of a frame
  EncodeReport report_;
  std::shared_ptr<Stretch> stretch_;
  std::deque<std::shared_ptr<Stretch>> known_;  ///< the latest whose meshes were written
  bool mesh_written_ = false;
  std::optional<GopCutter> cutter_;
  BoundingBox gop_box_;
  std::uint64_t frames_before_ = 0;  ///< those of meshes before the present one
  std::uint64_t first_frame_ = 0;    ///< of the sequence that was added: 0, or where a part begins
  bool finished_ = false;
  std::optional<Error> lost_;
};

}  // namespace tvg
