#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg::cli {

/// Which corner of another list of the same triangles each corner is: triangles may begin with another corner
/// and stand in another order.
class CornerMatch {
 public:
  /// Of each corner of `faces`, its place among the corners of `others`.
  CornerMatch(std::span<const Face> faces, std::span<const Face> others);

  /// False where not every triangle has one of the same corners in the same turn.
  bool found() const { return found_; }
  bool all_in_place() const { return places_.empty(); }
  std::size_t operator[](std::size_t corner) const { return places_.empty() ? corner : places_[corner]; }

 private:
  bool match_in_place(std::span<const Face> faces, std::span<const Face> others);
  bool match_anywhere(std::span<const Face> faces, std::span<const Face> others);

  std::vector<std::uint32_t> places_;  // empty where each is its own
  bool found_ = true;
};

}  // namespace tvg::cli
