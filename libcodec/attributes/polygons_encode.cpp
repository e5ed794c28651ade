#include "attributes/polygons_encode.hpp"

#include "attributes/polygon_coder.hpp"
#include "attributes/polygons.hpp"

#include <algorithm>

namespace tvg {

namespace {

/// The encoder's Guide: fans of a mesh whose faces are in the order of the traversal.
class KnownFans {
 public:
  explicit KnownFans(std::size_t faces) : places_(faces) {}

  /// `fan`: the first corner in each of its faces.
  void add(std::span<const std::uint32_t> fan) {
    for (std::size_t k = 0; k < fan.size(); ++k) places_[fan[k] / 3] = {fan[k], k > 0, k + 1 < fan.size()};
  }

  std::uint32_t start(std::uint32_t face) const {
    const Place& place = places_[face];
    if (place.followed) return 2 + 2 * (previous_corner(place.apex) % 3);
    return place.preceded ? 1 + 2 * (place.apex % 3) : 0;
  }

  bool goes_on(std::uint32_t apex, bool following) const {
    const Place& place = places_[apex / 3];
    return following ? place.followed : place.preceded;
  }

 private:
  struct Place {
    std::uint32_t apex = 0;
    bool preceded = false, followed = false;  ///< by another face of its fan
  };
  std::vector<Place> places_;  ///< [face]
};

/// The first corner of a polygon in each of its faces, in the order of the traversal; empty where that is no
/// fan. `place` is [face of the mesh encoded]: its number in the traversal.
std::vector<std::uint32_t> fan_of(const Polygon& polygon, std::span<const Face> faces,
                                  std::span<const std::uint32_t> partner,
                                  std::span<const std::uint32_t> place,
                                  std::span<const std::uint32_t> first_corners) {
  std::vector<std::uint32_t> fan;
  for (std::size_t face = polygon.first_triangle; fan.size() + 2 < polygon.corners; ++face) {
    const std::uint32_t traversed = place[face];
    const std::uint32_t apex = 3 * traversed + (3 - first_corners[traversed] % 3) % 3;
    if (!fan.empty()) {
      const bool in_turn = faces[face][0] == faces[face - 1][0] && faces[face][1] == faces[face - 1][2];
      if (!in_turn || fan_neighbour(partner, fan.back(), true) != apex) return {};
    }
    fan.push_back(apex);
  }
  return fan;
}

}  // namespace

// format-spec §5.9
EncodedPolygons encode_polygons(std::span<const Polygon> polygons, std::span<const Face> faces,
                                const PropertyMesh& mesh, std::span<const std::uint32_t> first_corners) {
  EncodedPolygons encoded;
  if (polygons.empty()) return encoded;
  std::vector<std::uint32_t> place(faces.size());
  for (std::uint32_t f = 0; f < first_corners.size(); ++f) place[first_corners[f] / 3] = f;
  const std::vector<std::uint32_t> partner = pair_edges(mesh.faces, mesh.vertex_count());
  KnownFans known(faces.size());
  for (const Polygon& polygon : polygons) {
    const std::vector<std::uint32_t> fan = fan_of(polygon, faces, partner, place, first_corners);
    if (fan.empty()) ++encoded.left_out;
    known.add(fan);
  }
  if (encoded.left_out == polygons.size()) return encoded;
  FaceFans fans;
  PolygonCoder coder(mesh, partner, known);
  RangeEncoder encoder;
  coder.code(encoder, fans);
  encoded.section = encoder.finish();
  return encoded;
}

}  // namespace tvg
