#pragma once
#include "simplify/quadric_error.hpp"
#include "simplify/vertex_remover.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <tvg/simplify.hpp>

namespace tvg {

/// Priorities of a mesh that is partly gone, [vertex of the original]: low ones are removed first.
using Priorities = std::function<Result<std::vector<double>>(const Mesh&)>;

/// Removes level after level down to the last of the counts. Vertices without faces go first, in a level of
/// their own; from then on they lie where the vertex does that is nearest to them in the first frame.
class LevelsOfRemoval {
 public:
  /// All must outlive it.
  LevelsOfRemoval(const Mesh& mesh, std::span<const FramePositions> frames, VertexRemover& remover,
                  const Priorities& priorities, const SimplifyProgress& progress);

  Status run(std::span<const std::uint32_t> vertex_counts);

  /// A mesh that was kept, and the levels that were done then.
  struct Kept {
    SimplifiedMesh mesh;
    std::size_t levels = 0;
  };
  std::vector<Kept> kept;                         ///< [count]
  std::vector<SimplifyLevel> levels;              ///< without their errors
  std::vector<std::uint32_t> removed;             ///< vertices of the original, in order
  std::vector<std::vector<PlacedVertex>> placed;  ///< [level] all that are gone and had faces

 private:
  void remove_isolated(std::span<const float> positions);
  Status run_level(std::uint32_t target, std::uint32_t attempt);
  void remove_in_order(std::span<const std::uint32_t> order, std::uint32_t target, std::uint32_t attempt);
  void end_level();
  void keep();
  SurfacePlace place_of(std::uint32_t vertex, std::span<const std::uint32_t> face_numbers,
                        std::span<const SurfacePlace> of_corners) const;

  const Mesh& mesh_;
  const std::span<const FramePositions> frames_;
  VertexRemover& remover_;
  const Priorities& priorities_;
  const SimplifyProgress& progress_;
  std::uint32_t left_, last_target_ = 0;
  SimplifyLevel level_;                  ///< the one that is being done
  std::vector<std::uint8_t> gone_;       ///< [vertex of the original]
  std::vector<std::uint8_t> refused_;    ///< [vertex of the cut mesh] since its ring changed
  std::vector<std::uint8_t> blocked_;    ///< [vertex of the cut mesh] in this level
  std::vector<std::uint32_t> stand_in_;  ///< [vertex of the original] itself, or the one it goes with
};

}  // namespace tvg
