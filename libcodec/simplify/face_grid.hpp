#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace tvg {

/// An axis-aligned box of float coordinates.
struct FloatBox {
  std::array<float, 3> low, high;

  bool overlaps(const FloatBox& other) const {
    return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
           other.low[1] <= high[1] && low[2] <= other.high[2] && other.low[2] <= high[2];
  }
};

/// Boxes by where they are. Each stands in the cells it touches, at most eight, of a grid whose cells are as
/// large as it, so that boxes of all sizes are found fast. Nothing is taken out: who asks must look whether
/// what is found is still there.
class FaceGrid {
 public:
  /// Forgets all and makes room for about so many.
  void clear(std::size_t expected);
  void insert(std::uint32_t face, const FloatBox& box);
  /// Appends every face that was put in with a box that overlaps this one, and others; some several times.
  void find(const FloatBox& box, std::vector<std::uint32_t>& found) const;

 private:
  struct Entry {
    std::uint32_t face, next;
  };
  struct Cells;

  std::uint32_t slot(int level, const std::array<std::int32_t, 3>& cell) const;

  std::vector<std::uint32_t> first_;  ///< [slot] place in entries_
  std::vector<Entry> entries_;
  std::vector<std::vector<std::uint32_t>> of_level_;  ///< [level] faces
};

}  // namespace tvg
