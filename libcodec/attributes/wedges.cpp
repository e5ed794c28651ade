#include "attributes/wedges.hpp"

#include "attributes/edge_pairs.hpp"

#include <algorithm>

namespace tvg {

namespace {

/// Sets of corners, each named by its first one.
class CornerSets {
 public:
  explicit CornerSets(std::size_t corners) : parent_(corners) {
    for (std::uint32_t c = 0; c < corners; ++c) parent_[c] = c;
  }

  std::uint32_t first(std::uint32_t corner) {
    while (parent_[corner] != corner) {
      parent_[corner] = parent_[parent_[corner]];
      corner = parent_[corner];
    }
    return corner;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    a = first(a);
    b = first(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  std::vector<std::uint32_t> take() { return std::move(parent_); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

Wedges wedges_between(std::span<const std::uint32_t> partner, std::span<const std::uint8_t> seams) {
  CornerSets sets(partner.size());
  for (std::uint32_t h = 0; h < partner.size(); ++h) {
    const std::uint32_t back = partner[h];
    if (back == kNoCorner || back > h || seams[h] != 0) continue;
    sets.join(h, next_corner(back));
    sets.join(next_corner(h), back);
  }
  Wedges wedges;
  for (std::uint32_t c = 0; c < partner.size(); ++c) {
    if (sets.first(c) == c) wedges.first.push_back(c);
  }
  wedges.of_corner.resize(partner.size());
  std::uint32_t met = 0;
  for (std::uint32_t c = 0; c < partner.size(); ++c) {
    const std::uint32_t first = sets.first(c);
    wedges.of_corner[c] = first == c ? met++ : wedges.of_corner[first];
  }
  return wedges;
}

std::vector<std::uint32_t> corners_of_vertices(std::span<const Face> faces) {
  std::vector<std::uint32_t> vertices;
  vertices.reserve(3 * faces.size());
  for (const Face& face : faces) vertices.insert(vertices.end(), face.begin(), face.end());
  return vertices;
}

}  // namespace tvg
