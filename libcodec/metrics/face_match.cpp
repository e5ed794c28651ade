#include "metrics/face_match.hpp"

#include <algorithm>

namespace tvg {

namespace {

/// A face, turned so that it is the smallest of its three turns.
struct TurnedFace {
  Face face{};
  std::uint32_t number = 0;
  std::uint32_t turn = 0;  ///< corner c is corner (c + turn) % 3 of the face as it was
};

std::vector<TurnedFace> turned(std::span<const Face> faces) {
  std::vector<TurnedFace> result(faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    const Face& face = faces[i];
    result[i] = {face, i, 0};
    for (std::uint32_t turn = 1; turn < 3; ++turn) {
      const Face other = {face[turn], face[(turn + 1) % 3], face[(turn + 2) % 3]};
      if (other < result[i].face) result[i] = {other, i, turn};
    }
  }
  std::sort(result.begin(), result.end(), [](const TurnedFace& a, const TurnedFace& b) {
    return a.face != b.face ? a.face < b.face : a.number < b.number;
  });
  return result;
}

}  // namespace

FaceMatch match_faces(std::span<const Face> original, std::span<const Face> decoded) {
  const std::vector<TurnedFace> left = turned(original), right = turned(decoded);
  FaceMatch match;
  match.pairs.reserve(std::min(left.size(), right.size()));
  for (auto a = left.begin(), b = right.begin(); a != left.end() && b != right.end();) {
    if (a->face == b->face) {
      match.pairs.push_back({a->number, b->number, (b->turn + 3 - a->turn) % 3});
      ++a;
      ++b;
    } else {
      a->face < b->face ? ++a : ++b;
    }
  }
  match.unmatched = left.size() + right.size() - 2 * match.pairs.size();
  return match;
}

}  // namespace tvg
