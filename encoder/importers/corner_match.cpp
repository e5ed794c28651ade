#include "encoder/importers/corner_match.hpp"

#include <algorithm>
#include <numeric>

namespace tvg::cli {

namespace {

/// The corner that a triangle begins with so that its smallest comes first.
std::uint32_t smallest_corner(const Face& face) {
  return static_cast<std::uint32_t>(std::min_element(face.begin(), face.end()) - face.begin());
}

Face turned(const Face& face, std::uint32_t by) {
  return {face[by % 3], face[(by + 1) % 3], face[(by + 2) % 3]};
}

/// Triangles in the order of their corners, equal ones in the order they have.
std::vector<std::uint32_t> sorted(std::span<const Face> faces) {
  std::vector<std::uint32_t> order(faces.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return turned(faces[a], smallest_corner(faces[a])) < turned(faces[b], smallest_corner(faces[b]));
  });
  return order;
}

}  // namespace

CornerMatch::CornerMatch(std::span<const Face> faces, std::span<const Face> others) {
  if (std::ranges::equal(faces, others)) return;
  if (faces.size() != others.size() || faces.size() > UINT32_MAX / 3) {
    found_ = false;
    return;
  }
  places_.resize(3 * faces.size());
  found_ = match_in_place(faces, others) || match_anywhere(faces, others);
}

bool CornerMatch::match_in_place(std::span<const Face> faces, std::span<const Face> others) {
  for (std::size_t face = 0; face < faces.size(); ++face) {
    std::uint32_t turn = 0;
    while (turn < 3 && turned(others[face], turn) != faces[face]) ++turn;
    if (turn == 3) return false;
    for (std::size_t corner = 0; corner < 3; ++corner)
      places_[3 * face + corner] = static_cast<std::uint32_t>(3 * face + (corner + turn) % 3);
  }
  return true;
}

bool CornerMatch::match_anywhere(std::span<const Face> faces, std::span<const Face> others) {
  const std::vector<std::uint32_t> ours = sorted(faces);
  const std::vector<std::uint32_t> theirs = sorted(others);
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const Face& our = faces[ours[i]];
    const Face& their = others[theirs[i]];
    const std::uint32_t our_first = smallest_corner(our);
    const std::uint32_t their_first = smallest_corner(their);
    if (turned(our, our_first) != turned(their, their_first)) return false;
    for (std::uint32_t corner = 0; corner < 3; ++corner)
      places_[3 * std::size_t{ours[i]} + (our_first + corner) % 3] =
          3 * theirs[i] + (their_first + corner) % 3;
  }
  return true;
}

}  // namespace tvg::cli
