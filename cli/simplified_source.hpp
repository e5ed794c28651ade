#pragma once
#include <vector>

#include <tvg/simplify.hpp>
#include <tvg/source.hpp>

namespace tvg::cli {

/// The frames of a source on some of its vertices, or at places of its surface.
class SimplifiedSource final : public FrameSource {
 public:
  enum class Keep { kPositions, kAttributes };

  /// Both must outlive it, as below. The original is to be rewound by the caller. kAttributes: those of
  /// vertices, where they do not change from frame to frame, stay.
  SimplifiedSource(FrameSource& original, const SimplifiedMesh& simplified, Keep keep = Keep::kPositions);
  SimplifiedSource(FrameSource& original, const Remesh& remeshed)
      : SimplifiedSource(original, remeshed.mesh, {}, remeshed.places) {}

  const Mesh& mesh() const override { return mesh_; }
  const MeshProperties& properties() const override { return properties_; }
  Metadata metadata() const override { return original_.metadata(); }
  std::optional<std::uint64_t> frame_count() const override { return original_.frame_count(); }
  Result<bool> read_frame(std::span<float> positions) override;
  Status skip_frames(std::uint64_t count) override { return original_.skip_frames(count); }
  bool rewind() override { return original_.rewind(); }

  /// The frame of the original that was read last, [vertex][xyz].
  const FramePositions& original_frame() const { return frame_; }

 private:
  SimplifiedSource(FrameSource& original, const Mesh& mesh, std::span<const std::uint32_t> vertices,
                   std::span<const SurfacePlace> places)
      : original_(original),
        mesh_(mesh),
        vertices_(vertices),
        places_(places),
        frame_(3 * std::size_t{original.mesh().vertex_count}) {}

  FrameSource& original_;
  const Mesh& mesh_;
  std::span<const std::uint32_t> vertices_;  // of the original; empty where there are places
  std::span<const SurfacePlace> places_;
  FramePositions frame_;
  MeshProperties properties_;
};

/// The positions of `vertices` ([vertex of the result]) among all of a mesh, [vertex][xyz].
void gather(std::span<const std::uint32_t> vertices, std::span<const float> positions,
            std::span<float> result);

}  // namespace tvg::cli
