#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// Which faces of two lists are the same: they have the same vertices in the same turn, whichever comes
/// first.
struct FaceMatch {
  struct Pair {
    std::uint32_t original = 0, decoded = 0;
    std::uint32_t turn = 0;  ///< corner c of the original is corner (c + turn) % 3 of the decoded one
  };
  std::vector<Pair> pairs;      ///< faces that are there several times are paired in their order
  std::uint64_t unmatched = 0;  ///< faces of either list without one of the other
};

FaceMatch match_faces(std::span<const Face> original, std::span<const Face> decoded);

}  // namespace tvg
