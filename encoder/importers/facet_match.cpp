#include "encoder/importers/facet_match.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <utility>

namespace tvg::cli {

namespace {

constexpr std::uint32_t kNone = UINT32_MAX;
// Looking for the nearest facet takes a look at all of them, once per piece.
constexpr std::uint64_t kMostLooks = 200'000'000;
constexpr std::size_t kSeeds = 12;

/// The two facets at each edge, where there are just two.
class Edges {
 public:
  explicit Edges(const std::vector<std::uint32_t>& vertices) {
    pairs_.reserve(vertices.size() / 2 + 1);
    for (std::uint32_t corner = 0; corner < vertices.size(); ++corner) {
      const std::uint32_t next = corner - corner % 3 + (corner + 1) % 3;
      Pair& pair = pairs_[key(vertices[corner], vertices[next])];
      if (pair.count < 2) pair.facets[pair.count] = corner / 3;
      ++pair.count;
    }
  }

  /// The facet across the edge of two vertices; kNone where there is none or more than one.
  std::uint32_t across(std::uint32_t facet, std::uint32_t a, std::uint32_t b) const {
    const auto entry = pairs_.find(key(a, b));
    if (entry == pairs_.end() || entry->second.count != 2) return kNone;
    const auto& facets = entry->second.facets;
    return facets[0] == facet ? facets[1] : facets[0];
  }

 private:
  struct Pair {
    std::array<std::uint32_t, 2> facets = {kNone, kNone};
    std::uint32_t count = 0;
  };
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }
  std::unordered_map<std::uint64_t, Pair> pairs_;
};

class Matcher {
 public:
  Matcher(std::span<const float> before, const Weld& before_weld, std::span<const float> frame,
          const Weld& frame_weld)
      : before_(before),
        frame_(frame),
        ours_(before_weld.vertex_of_point),
        theirs_(frame_weld.vertex_of_point),
        our_edges_(ours_),
        their_edges_(theirs_),
        corner_(ours_.size(), kNone),
        taken_(ours_.size() / 3, false),
        vertex_(before_weld.vertex_count(), kNone),
        back_(frame_weld.vertex_count(), kNone) {}

  std::optional<FacetMatch> run() {
    const std::size_t facets = ours_.size() / 3;
    std::uint64_t looks = 0;
    for (std::uint32_t facet = 0; facet < facets; ++facet) {
      if (corner_[3 * std::size_t{facet}] != kNone) continue;
      looks += facets;
      if (looks > kMostLooks || !match_piece(facet)) return std::nullopt;
    }
    return FacetMatch{std::move(corner_)};
  }

 private:
  struct Seed {
    double distance = 0;
    std::uint32_t facet = 0;
    std::uint32_t turn = 0;
  };

  /// The sum of squared distances of the corners, where corner c of the one is c + turn of the other.
  double distance(std::uint32_t ours, std::uint32_t theirs, std::uint32_t turn) const {
    double sum = 0;
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::size_t a = 3 * (3 * std::size_t{ours} + c);
      const std::size_t b = 3 * (3 * std::size_t{theirs} + (c + turn) % 3);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = double{before_[a + axis]} - double{frame_[b + axis]};
        sum += d * d;
      }
    }
    return sum;
  }

  std::vector<Seed> nearest(std::uint32_t facet) const {
    std::vector<Seed> seeds;
    for (std::uint32_t other = 0; other < taken_.size(); ++other) {
      if (taken_[other]) continue;
      for (std::uint32_t turn = 0; turn < 3; ++turn)
        seeds.push_back({distance(facet, other, turn), other, turn});
    }
    const auto nearer = [](const Seed& a, const Seed& b) { return a.distance < b.distance; };
    const std::size_t count = std::min(kSeeds, seeds.size());
    std::partial_sort(seeds.begin(), seeds.begin() + static_cast<std::ptrdiff_t>(count), seeds.end(), nearer);
    seeds.resize(count);
    return seeds;
  }

  /// Matches all that hangs together with a facet. Another order that is nearly as near makes it ambiguous.
  bool match_piece(std::uint32_t facet) {
    constexpr double kClearly = 4;  // twice as far
    const std::vector<Seed> seeds = nearest(facet);
    std::optional<Seed> found;
    for (const Seed& seed : seeds) {
      if (found && seed.distance > kClearly * found->distance) break;
      if (!spread(facet, seed)) continue;
      undo();
      if (found) return false;
      found = seed;
    }
    if (!found || !spread(facet, *found)) return false;
    named_.clear();
    return true;
  }

  bool spread(std::uint32_t facet, const Seed& seed) {
    placed_.clear();
    named_.clear();
    bool fits = place(facet, seed.facet, seed.turn);
    for (std::size_t next = 0; fits && next < placed_.size(); ++next) {
      for (std::uint32_t c = 0; fits && c < 3; ++c) fits = cross(placed_[next], c);
    }
    if (!fits) undo();
    return fits;
  }

  /// From a facet that has its match over the edge behind its corner c: both go on there or neither.
  bool cross(std::uint32_t facet, std::uint32_t c) {
    const std::size_t first = 3 * std::size_t{facet};
    const std::uint32_t a = ours_[first + c];
    const std::uint32_t b = ours_[first + (c + 1) % 3];
    const std::uint32_t neighbour = our_edges_.across(facet, a, b);
    const std::uint32_t match = corner_[first] / 3;
    const std::uint32_t other = their_edges_.across(match, vertex_[a], vertex_[b]);
    if ((neighbour == kNone) != (other == kNone)) return false;
    if (neighbour == kNone) return true;
    const std::uint32_t there = corner_[3 * std::size_t{neighbour}];
    if (there != kNone) return there / 3 == other;
    for (std::uint32_t turn = 0; turn < 3; ++turn) {
      if (fits(neighbour, other, turn)) return place(neighbour, other, turn);
    }
    return false;
  }

  /// Whether no vertex of the two facets has another match already.
  bool fits(std::uint32_t facet, std::uint32_t other, std::uint32_t turn) const {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t ours = ours_[3 * std::size_t{facet} + c];
      const std::uint32_t theirs = theirs_[3 * std::size_t{other} + (c + turn) % 3];
      if (vertex_[ours] != theirs && (vertex_[ours] != kNone || back_[theirs] != kNone)) return false;
    }
    return true;
  }

  bool place(std::uint32_t facet, std::uint32_t other, std::uint32_t turn) {
    if (taken_[other] || !fits(facet, other, turn)) return false;
    taken_[other] = true;
    placed_.push_back(facet);
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t corner = 3 * other + (c + turn) % 3;
      corner_[3 * std::size_t{facet} + c] = corner;
      const std::uint32_t ours = ours_[3 * std::size_t{facet} + c];
      const std::uint32_t theirs = theirs_[corner];
      if (vertex_[ours] != kNone) continue;
      vertex_[ours] = theirs;
      back_[theirs] = ours;
      named_.emplace_back(ours, theirs);
    }
    return consistent(facet);  // a facet with a corner twice must have it twice in both
  }

  bool consistent(std::uint32_t facet) const {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::size_t corner = 3 * std::size_t{facet} + c;
      if (vertex_[ours_[corner]] != theirs_[corner_[corner]]) return false;
    }
    return true;
  }

  void undo() {
    for (const std::uint32_t facet : placed_) {
      taken_[corner_[3 * std::size_t{facet}] / 3] = false;
      for (std::size_t c = 0; c < 3; ++c) corner_[3 * std::size_t{facet} + c] = kNone;
    }
    placed_.clear();
    for (const auto& [ours, theirs] : named_) {
      vertex_[ours] = kNone;
      back_[theirs] = kNone;
    }
    named_.clear();
  }

  std::span<const float> before_;
  std::span<const float> frame_;
  const std::vector<std::uint32_t>& ours_;    // [corner]: vertex of the frame before
  const std::vector<std::uint32_t>& theirs_;  // [corner]: vertex of the frame
  Edges our_edges_;
  Edges their_edges_;
  std::vector<std::uint32_t> corner_;  // as FacetMatch has it
  std::vector<bool> taken_;            // [facet of the frame]
  std::vector<std::uint32_t> vertex_;  // [vertex of the frame before]: that of the frame
  std::vector<std::uint32_t> back_;    // the same backwards
  std::vector<std::uint32_t> placed_;  // facets of the present piece
  std::vector<std::pair<std::uint32_t, std::uint32_t>> named_;  // its vertices that had no match before
};

}  // namespace

std::optional<FacetMatch> match_facets(std::span<const float> before, const Weld& before_weld,
                                       std::span<const float> frame, const Weld& frame_weld) {
  if (before.size() != frame.size() || before_weld.vertex_count() != frame_weld.vertex_count())
    return std::nullopt;
  return Matcher(before, before_weld, frame, frame_weld).run();
}

}  // namespace tvg::cli
