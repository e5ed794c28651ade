#include "attributes/polygon_coder.hpp"
#include "attributes/polygons.hpp"
#include "base/allocation.hpp"
#include "base/stream_error.hpp"

#include <span>
#include <utility>

namespace tvg {

namespace {

/// The decoder's Guide: it knows nothing.
struct NoFans {
  static std::uint32_t start(std::uint32_t /*face*/) { return 0; }
  static bool goes_on(std::uint32_t /*apex*/, bool /*following*/) { return false; }
};

/// What is in memory at once, the result included, whose lists may be twice as long while they grow.
std::size_t working_bytes(const PropertyMesh& mesh) {
  constexpr std::size_t kModels = std::size_t{1} << 15, kPerFace = 80;
  return pair_edges_bytes(mesh.faces.size(), mesh.vertex_count()) + kPerFace * mesh.faces.size() + kModels;
}

/// [face][corner]: moves what corners have.
template <class Value>
[[nodiscard]] bool turn_corners(std::span<const std::uint32_t> first_corners, std::vector<Value>& values) {
  std::vector<Value> turned;
  if (!try_reserve(turned, values.size())) return false;
  for (std::uint32_t corner : first_corners) {
    for (int i = 0; i < 3; ++i, corner = next_corner(corner)) turned.push_back(values[corner]);
  }
  values = std::move(turned);
  return true;
}

}  // namespace

// format-spec §5.9
Result<FaceFans> decode_polygons(Bytes section, const PropertyMesh& mesh, PropertyBudget& budget) {
  constexpr const char* kSection = "§5.9";
  if (!can_allocate(working_bytes(mesh))) return out_of_memory();
  const std::vector<std::uint32_t> partner = pair_edges(mesh.faces, mesh.vertex_count());
  FaceFans fans;
  fans.first_corners.reserve(mesh.faces.size());
  NoFans guide;
  PolygonCoder coder(mesh, partner, guide);
  RangeDecoder decoder(section);
  if (!coder.code(decoder, fans) || !decoder.finished())
    return malformed(kSection, "the polygons of a mesh are damaged");
  if (!budget.take(kPolygonBytes * fans.polygons.size())) {
    return stream_error(ErrorCode::kLimitExceeded, kSection,
                        {"the properties of a mesh take more than the head declares"});
  }
  return fans;
}

Status take_fans(FaceFans fans, std::vector<Face>& faces, MeshProperties& properties) {
  const std::span<const std::uint32_t> first_corners = fans.first_corners;
  std::vector<Face> turned;
  if (!try_reserve(turned, faces.size())) return out_of_memory();
  for (const std::uint32_t corner : first_corners) {
    const Face& face = faces[corner / 3];
    const std::size_t i = corner % 3;
    turned.push_back({face[i], face[(i + 1) % 3], face[(i + 2) % 3]});
  }
  faces = std::move(turned);
  if (!properties.face_parts.empty()) {
    std::vector<std::uint32_t> parts;
    if (!try_reserve(parts, faces.size())) return out_of_memory();
    for (const std::uint32_t corner : first_corners) parts.push_back(properties.face_parts[corner / 3]);
    properties.face_parts = std::move(parts);
  }
  for (Attribute& attribute : properties.attributes) {
    if (!attribute.corners.empty() && !turn_corners(first_corners, attribute.corners)) return out_of_memory();
  }
  properties.polygons = std::move(fans.polygons);
  return {};
}

}  // namespace tvg
