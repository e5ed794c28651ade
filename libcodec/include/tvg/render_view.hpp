#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// A mesh as graphics hardware takes it: one index for everything a vertex has. A vertex whose corners differ
/// in an attribute becomes several *render vertices*, and faces are sorted by their part, so that each part
/// is one run of the index buffer. Made once for a mesh; what changes with frames is then copied without an
/// allocation.
///
/// Render vertex i is vertex i for every i below the mesh's vertex count, whether faces use it or not, and
/// further ones follow in the order of their vertices: where no attribute differs at the corners of a vertex,
/// the index buffer has the mesh's own indices.
class RenderView {
 public:
  /// Of a render vertex that no face uses: it has no value of attributes of corners and parts.
  static constexpr std::uint32_t kNoValue = UINT32_MAX;

  /// A run of the index buffer.
  struct Range {
    std::size_t first_index = 0;
    std::size_t index_count = 0;  ///< three to a face; 0 where the part has none

    bool operator==(const Range&) const = default;
  };

  /// Of no mesh; everything is empty.
  RenderView() = default;
  /// kInvalidInput where an index is out of range or an attribute or the parts do not fit the mesh;
  /// kLimitExceeded where there would be 2^32 - 1 render vertices or more; kOutOfMemory. The values of
  /// animated attributes are not looked at. Nothing of what it is given needs to outlive the call.
  static Result<RenderView> of(const Mesh& mesh, const MeshProperties& properties);

  /// Render vertices.
  std::size_t vertex_count() const { return source_vertices_.size(); }
  /// [render vertex]: the vertex it is.
  std::span<const std::uint32_t> source_vertices() const { return source_vertices_; }
  /// The index buffer, three render vertices to a face, each face turned as in the mesh.
  std::span<const std::uint32_t> indices() const { return indices_; }
  /// [face of the index buffer]: which of the mesh's faces it is. Faces of a part stay in their order.
  std::span<const std::uint32_t> source_faces() const { return source_faces_; }
  /// [part], where its faces are in the index buffer; one range of all faces for a mesh without parts.
  std::span<const Range> ranges() const { return ranges_; }

  std::size_t attribute_count() const { return attributes_.size(); }
  /// [render vertex]: which value of the attribute (by its place in the properties) it has, or kNoValue. An
  /// attribute of vertices has those of source_vertices(), one of parts the numbers of parts. Empty for an
  /// attribute that is not there.
  std::span<const std::uint32_t> value_indices(std::size_t attribute) const;

  /// Copies what every vertex has three numbers of (positions, normals; [vertex][xyz], for at least all
  /// vertices of the mesh): those of render vertex i as float32 to `target` + i * `stride` bytes. `stride` is
  /// at least 12. kInvalidArgument where either is too small. Does not allocate.
  Status copy_vertices(std::span<const float> values, std::span<std::byte> target,
                       std::size_t stride = 12) const;
  /// The same for an attribute: `values` are [value][component], those of the properties or, of an animated
  /// attribute, those of a frame; `stride` is at least four bytes for each component, and a render vertex
  /// without a value gets zeros.
  Status copy_attribute(std::size_t attribute, std::span<const float> values, std::span<std::byte> target,
                        std::size_t stride) const;

 private:
  class Builder;

  struct ViewedAttribute {
    AttributeDomain domain = AttributeDomain::kVertex;
    std::uint32_t components = 1;
    std::size_t values_needed = 0;       ///< one more than the largest number of a value that is used
    std::vector<std::uint32_t> indices;  ///< as value_indices(); empty for an attribute of vertices
  };

  std::size_t mesh_vertices_ = 0;
  std::vector<std::uint32_t> source_vertices_, indices_, source_faces_;
  std::vector<Range> ranges_;
  std::vector<ViewedAttribute> attributes_;
};

}  // namespace tvg
