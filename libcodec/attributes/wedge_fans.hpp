#pragma once
#include "attributes/edge_pairs.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tvg {

/// What values belong to, and which of them lie beside each other: wedges of corners, or vertices, or parts.
class WedgeFans {
 public:
  /// `of_corner`, [3 * face + corner], is below `count`; empty where the values have no corners.
  WedgeFans(std::span<const std::uint32_t> of_corner, std::size_t count)
      : of_corner_(of_corner), begin_(count + 1), corners_(of_corner.size()) {
    for (const std::uint32_t w : of_corner) ++begin_[w];
    for (std::size_t w = 0, sum = 0; w <= count; ++w)
      sum += std::exchange(begin_[w], static_cast<std::uint32_t>(sum));
    for (std::uint32_t c = 0; c < of_corner.size(); ++c) corners_[begin_[of_corner[c]]++] = c;
    for (std::size_t w = count; w > 0; --w) begin_[w] = begin_[w - 1];
    begin_[0] = 0;
  }

  std::size_t count() const { return begin_.size() - 1; }
  std::uint32_t of(std::uint32_t corner) const { return of_corner_[corner]; }
  /// The corners of a wedge, ascending.
  std::span<const std::uint32_t> corners(std::uint32_t wedge) const {
    return std::span(corners_).subspan(begin_[wedge], begin_[wedge + 1] - begin_[wedge]);
  }

 private:
  std::span<const std::uint32_t> of_corner_;
  std::vector<std::uint32_t> begin_;    ///< [wedge]
  std::vector<std::uint32_t> corners_;  ///< by wedge
};

}  // namespace tvg
