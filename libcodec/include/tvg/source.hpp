#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/skeleton.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// Frames of one mesh over time, all in memory.
struct Sequence {
  Mesh mesh;
  std::vector<FramePositions> frames;  ///< [frame][vertex][xyz]
  Metadata metadata;
};

/// A source of frames that is read front to back, so that no one has to hold a whole sequence in memory. What
/// needs to see everything twice, rewinds it where it can and does without where it cannot.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The connectivity of every frame; valid as long as the source.
  virtual const Mesh& mesh() const = 0;
  /// What the mesh has beside its connectivity; valid as long as the mesh.
  virtual const MeshProperties& properties() const;
  /// The values of an animated attribute (by its place in properties()) in the frame that was read last,
  /// [value][component]; valid until the next is read.
  virtual std::span<const float> animated_values(std::size_t /*attribute*/) const { return {}; }
  /// What the source knows about itself (fps, name, units).
  virtual Metadata metadata() const { return {}; }
  /// Free-form data that go with the sequence. Valid as long as the source.
  virtual std::span<const NamedData> data() const { return {}; }
  /// The joints that move the mesh; empty where the source knows of none. Valid as long as the source.
  virtual const Skeleton& skeleton() const;
  /// Where the joints are in the frame that was read last, [joint][xyz]; valid until the next is read.
  virtual std::span<const float> joint_positions() const { return {}; }
  /// Number of frames, where the source can know it before reading (a pipe may not).
  virtual std::optional<std::uint64_t> frame_count() const = 0;
  /// Reads the next frame into `positions` ([vertex][xyz], exactly 3 * vertex_count floats).
  /// Returns false at the end of the sequence; an error when the input is broken.
  virtual Result<bool> read_frame(std::span<float> positions) = 0;
  /// After read_frame() gave an error: true where that says no more than that the mesh is another one from
  /// this frame on. The source then goes on with that mesh, which mesh() is now, and the frame is read next.
  /// (So that who knows of one mesh only is told.)
  virtual Result<bool> begin_next_mesh() { return false; }
  /// Whether the mesh may be another one later, so that it pays to look through the source before. (Where it
  /// says no, that is a promise.)
  virtual bool mesh_may_change() const { return false; }
  /// Passes over `count` frames, which are within the sequence: reads them, where there is no shorter way.
  /// mesh() may be another one after it.
  virtual Status skip_frames(std::uint64_t count);
  /// Goes back to the first frame and its mesh. Returns false where the input can be read only once (a pipe).
  virtual bool rewind() = 0;
};

/// What comes next of a source.
enum class SourceStep : std::uint8_t { kFrame, kMesh, kEnd };

/// Reads the next frame into `frame`, which gets its size ([vertex][xyz]); or goes on with the next mesh
/// where that begins here, and the frame is read next. Fails as the source does.
Result<SourceStep> read_step(FrameSource& source, FramePositions& frame);

/// The values of each attribute of the frame that was read last, empty where it is not animated:
/// Encoder::add_frame() takes them so. Valid until the next is read.
std::vector<std::span<const float>> all_animated_values(const FrameSource& source);

/// A source that is another one, but for what a class derived from it overrides.
class SourceDecorator : public FrameSource {
 public:
  explicit SourceDecorator(std::unique_ptr<FrameSource> source) : source_(std::move(source)) {}

  const Mesh& mesh() const override { return source_->mesh(); }
  const MeshProperties& properties() const override { return source_->properties(); }
  std::span<const float> animated_values(std::size_t attribute) const override {
    return source_->animated_values(attribute);
  }
  Metadata metadata() const override { return source_->metadata(); }
  std::span<const NamedData> data() const override { return source_->data(); }
  const Skeleton& skeleton() const override { return source_->skeleton(); }
  std::span<const float> joint_positions() const override { return source_->joint_positions(); }
  std::optional<std::uint64_t> frame_count() const override { return source_->frame_count(); }
  Result<bool> read_frame(std::span<float> positions) override { return source_->read_frame(positions); }
  Result<bool> begin_next_mesh() override { return source_->begin_next_mesh(); }
  bool mesh_may_change() const override { return source_->mesh_may_change(); }
  Status skip_frames(std::uint64_t count) override { return source_->skip_frames(count); }
  bool rewind() override { return source_->rewind(); }

 private:
  std::unique_ptr<FrameSource> source_;
};

/// A FrameSource over frames in memory; the sequence and the joints, if any, must outlive it. Frames of
/// joints go with those of the sequence by number.
class SequenceSource final : public FrameSource {
 public:
  explicit SequenceSource(const Sequence& sequence, const JointTracks* joints = nullptr)
      : sequence_(sequence), joints_(joints) {}

  const Mesh& mesh() const override { return sequence_.mesh; }
  Metadata metadata() const override { return sequence_.metadata; }
  const Skeleton& skeleton() const override;
  std::span<const float> joint_positions() const override;
  std::optional<std::uint64_t> frame_count() const override { return sequence_.frames.size(); }
  Result<bool> read_frame(std::span<float> positions) override;
  bool rewind() override {
    next_ = 0;
    return true;
  }

 private:
  const Sequence& sequence_;
  const JointTracks* joints_;
  std::size_t next_ = 0;
};

}  // namespace tvg
