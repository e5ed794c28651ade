#pragma once
#include "connectivity/connectivity.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tvg {

/// The order in which a shape's vertices are coded (format-spec §5.3.2): next is who has most neighbours
/// among those that are coded, of equal ones who has waited longest with so many; where nobody has any, the
/// first that is left.
class ShapeOrder {
 public:
  static constexpr std::size_t kBytesPerVertex = 2 * sizeof(std::uint32_t) + 1;

  explicit ShapeOrder(std::uint32_t vertex_count)
      : links_(vertex_count, Link{kNoVertex, kNoVertex}), standing_(vertex_count, 0) {
    first_.fill(kNoVertex);
    last_.fill(kNoVertex);
  }

  /// The next vertex, which counts as coded from now on; there is one left.
  std::uint32_t next() {
    std::uint32_t vertex = 0;
    if (waiting_ != 0) {
      const auto standing = static_cast<std::size_t>(std::bit_width(waiting_) - 1);
      vertex = first_[standing];
      take_out(vertex, standing);
    } else {
      while (standing_[seed_] == kCoded) ++seed_;
      vertex = seed_;
    }
    standing_[vertex] = kCoded;
    return vertex;
  }

  /// A neighbour of `vertex` has been coded.
  void raise(std::uint32_t vertex) {
    const std::uint8_t standing = standing_[vertex];
    if (standing >= kHighest) return;
    if (standing > 0) take_out(vertex, standing);
    put_in(vertex, ++standing_[vertex]);
  }

 private:
  static constexpr std::uint8_t kHighest = 15, kCoded = 255;

  struct Link {
    std::uint32_t previous, next;
  };

  void put_in(std::uint32_t vertex, std::size_t standing) {
    const std::uint32_t last = last_[standing];
    links_[vertex] = {last, kNoVertex};
    (last == kNoVertex ? first_[standing] : links_[last].next) = vertex;
    last_[standing] = vertex;
    waiting_ |= 1u << standing;
  }

  void take_out(std::uint32_t vertex, std::size_t standing) {
    const Link link = links_[vertex];
    (link.previous == kNoVertex ? first_[standing] : links_[link.previous].next) = link.next;
    (link.next == kNoVertex ? last_[standing] : links_[link.next].previous) = link.previous;
    if (first_[standing] == kNoVertex) waiting_ &= ~(1u << standing);
  }

  std::vector<Link> links_;                                   ///< [vertex]
  std::vector<std::uint8_t> standing_;                        ///< [vertex]: coded neighbours, up to kHighest
  std::array<std::uint32_t, kHighest + 1> first_{}, last_{};  ///< [standing]
  std::uint32_t waiting_ = 0;                                 ///< bit s: somebody stands at s
  std::uint32_t seed_ = 0;
};

}  // namespace tvg
