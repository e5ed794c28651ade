#include "encoder/importers/face_order.hpp"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

/// Faces as their corners, each beginning with its smallest, sorted.
class SortedFaces {
  static constexpr int kMostCandidates = 8;

 public:
  SortedFaces(std::span<const Face> triangles, std::span<const Polygon> polygons) {
    corners_.reserve(3 * triangles.size());
    for (std::size_t triangle = 0; triangle < triangles.size();) {
      const bool is_polygon = !polygons.empty() && polygons.front().first_triangle == triangle;
      const std::size_t count = is_polygon ? polygons.front().corners : 3;
      if (is_polygon) polygons = polygons.subspan(1);
      add(triangles.subspan(triangle, count - 2), triangle);
      triangle += count - 2;
    }
    std::sort(faces_.begin(), faces_.end(), [this](const Entry& a, const Entry& b) { return less(a, b); });
  }

  struct Entry {
    std::size_t begin = 0;  ///< of its corners
    std::size_t size = 0;
    std::size_t triangle = 0;  ///< the first of its fan
  };
  const std::vector<Entry>& faces() const { return faces_; }
  std::span<const std::uint32_t> corners(const Entry& face) const {
    return std::span(corners_).subspan(face.begin, face.size);
  }

 private:
  void add(std::span<const Face> fan, std::size_t triangle) {
    const std::size_t begin = corners_.size();
    corners_.insert(corners_.end(), {fan[0][0], fan[0][1]});
    for (const Face& face : fan) corners_.push_back(face[2]);
    const auto first = corners_.begin() + static_cast<std::ptrdiff_t>(begin);
    std::rotate(first, smallest_turn(first, corners_.end()), corners_.end());
    faces_.push_back({begin, corners_.size() - begin, triangle});
  }

  /// Where a face begins so that its corners are in the smallest order; a corner may come twice. Of faces
  /// whose smallest corner comes often only the first few are looked at: nobody draws them.
  template <class Iterator>
  static Iterator smallest_turn(Iterator first, Iterator last) {
    const auto size = last - first;
    Iterator best = std::min_element(first, last);
    int candidates = 0;
    for (Iterator candidate = best + 1; candidate != last; ++candidate) {
      if (*candidate != *best || ++candidates > kMostCandidates) continue;
      for (std::ptrdiff_t i = 1; i < size; ++i) {
        const std::uint32_t a = first[(candidate - first + i) % size];
        const std::uint32_t b = first[(best - first + i) % size];
        if (a == b) continue;
        if (a < b) best = candidate;
        break;
      }
    }
    return best;
  }

  bool less(const Entry& a, const Entry& b) const {
    return std::ranges::lexicographical_compare(corners(a), corners(b));
  }

  std::vector<std::uint32_t> corners_;
  std::vector<Entry> faces_;
};

bool same_turned(const Face& a, const Face& b) {
  return a == b || (a[0] == b[1] && a[1] == b[2] && a[2] == b[0]) ||
         (a[0] == b[2] && a[1] == b[0] && a[2] == b[1]);
}

}  // namespace

FaceOrder::FaceOrder(std::vector<Face> faces, std::vector<Polygon> polygons)
    : faces_(std::move(faces)), polygons_(std::move(polygons)) {}

std::string FaceOrder::difference(const MeshFile& other, const std::string& file) const {
  if (other.faces.size() != faces_.size())
    return fmt::format("has {} triangles where {} has {}", other.faces.size(), file, faces_.size());
  if (std::equal(faces_.begin(), faces_.end(), other.faces.begin(), same_turned)) return "";
  const SortedFaces ours(faces_, polygons_);
  const SortedFaces theirs(other.faces, other.polygons);
  const auto same = [&](const SortedFaces::Entry& a, const SortedFaces::Entry& b) {
    return std::ranges::equal(ours.corners(a), theirs.corners(b));
  };
  const auto [left, right] = std::mismatch(ours.faces().begin(), ours.faces().end(), theirs.faces().begin(),
                                           theirs.faces().end(), same);
  if (left == ours.faces().end() && right == theirs.faces().end()) return "";
  if (right == theirs.faces().end()) return fmt::format("has fewer faces than {}", file);
  const auto corners = theirs.corners(*right);
  const auto inside_out = [&](const SortedFaces::Entry& face) {
    std::vector<std::uint32_t> turned(corners.rbegin(), corners.rend());
    std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
    return std::ranges::equal(ours.corners(face), turned);
  };
  const bool flipped = std::any_of(ours.faces().begin(), ours.faces().end(), inside_out);
  return fmt::format("has the vertices {} in triangle {}, {} {}", fmt::join(corners, " "), right->triangle,
                     flipped ? "the face turned inside out of one in" : "a face that is not in", file);
}

}  // namespace tvg::cli
