#pragma once
#include <vector>

#include <tvg/simplify.hpp>
#include <tvg/source.hpp>

namespace tvg::cli {

/// The frames of a source on some of its vertices.
class SimplifiedSource final : public FrameSource {
 public:
  /// Both must outlive it. The original is to be rewound by the caller.
  SimplifiedSource(FrameSource& original, const SimplifiedMesh& simplified)
      : original_(original), simplified_(simplified), frame_(3 * std::size_t{original.mesh().vertex_count}) {}

  const Mesh& mesh() const override { return simplified_.mesh; }
  Metadata metadata() const override { return original_.metadata(); }
  std::optional<std::uint64_t> frame_count() const override { return original_.frame_count(); }
  Result<bool> read_frame(std::span<float> positions) override;
  Status skip_frames(std::uint64_t count) override { return original_.skip_frames(count); }
  bool rewind() override { return original_.rewind(); }

  /// The frame of the original that was read last, [vertex][xyz].
  const FramePositions& original_frame() const { return frame_; }

 private:
  FrameSource& original_;
  const SimplifiedMesh& simplified_;
  FramePositions frame_;
};

/// The positions of `vertices` ([vertex of the result]) among all of a mesh, [vertex][xyz].
void gather(std::span<const std::uint32_t> vertices, std::span<const float> positions,
            std::span<float> result);

}  // namespace tvg::cli
