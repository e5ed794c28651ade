#pragma once
#include "player/view/materials.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/render_view.hpp>
#include <tvg/types.hpp>

namespace tvg::player {

/// How the surface of a mesh looks by what the stream has of it: colours, textures, materials of its parts,
/// and edges where its normals part. Vertices are those of the view; it never changes.
struct Surface {
  /// Faces that are drawn in one go.
  struct Run {
    RenderView::Range faces;
    ShownMaterial material;
    bool is_plain = false;  ///< it has no material: drawn in the style's colour where vertices have none
  };

  RenderView view;
  std::vector<Run> runs;
  std::vector<float> colours;  ///< [render vertex][rgba], sRGB; empty without, and where frames have them
  /// The mesh's attribute that is the colour where each frame has its own: its place, and its components.
  struct FrameColours {
    std::size_t attribute = 0;
    std::uint32_t components = 0;
  };
  std::optional<FrameColours> frame_colours;
  std::vector<float> texcoords;  ///< [render vertex][uv], v from the picture's top; empty without
  /// Vertices that share a normal: [render vertex], its group, and the view's faces by groups.
  std::vector<std::uint32_t> groups;
  std::vector<Face> group_faces;
  std::size_t group_count = 0;
};

/// Null where the properties say nothing of the looks, and where they cannot be had.
std::shared_ptr<const Surface> make_surface(const Mesh& mesh, const MeshProperties& properties,
                                            const ShownMaterials& materials);

/// What changes with frames, as a surface has it. Memory is used again.
class SurfaceFrame {
 public:
  /// `positions`: [vertex][xyz]. Normals are those of the faces around each vertex, up to where the stream's
  /// normals part.
  /// `colours`: of Surface::frame_colours, [value][component].
  void set(const Surface& surface, std::span<const float> positions, std::span<const float> colours = {});

  std::span<const float> positions() const { return positions_; }  ///< [render vertex][xyz]
  std::span<const float> normals() const { return normals_; }      ///< [render vertex][xyz]
  /// [render vertex][rgba]; empty where the surface's own go.
  std::span<const float> colours() const { return colours_; }

 private:
  std::vector<float> positions_, normals_, colours_, group_positions_, group_normals_;
};

}  // namespace tvg::player
