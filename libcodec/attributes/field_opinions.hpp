#pragma once
#include "attributes/attribute_grid.hpp"
#include "attributes/opinions.hpp"
#include "attributes/surface_vectors.hpp"
#include "attributes/wedge_fans.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// What is known of a value of texture coordinates, colours or numbers.
struct FieldValue {
  static constexpr std::size_t kOpinions = 4;

  std::array<double, kMaxAttributeComponents> value{};
  std::array<double, kOpinions> missed{};                    ///< by how much each opinion missed it
  std::array<std::int32_t, kMaxAttributeComponents> size{};  ///< of its residuals
  bool known = false;
};

/// What the values beside say of one that is not known yet (format-spec §5.7.4).
class FieldOpinions {
 public:
  using Value = std::array<double, kMaxAttributeComponents>;
  /// The numbers of the opinions. The third needs a reference shape, the last is of texture coordinates too;
  /// of changes it is how the value changed before.
  enum Opinion : std::size_t { kParallelogram = 0, kMean = 1, kAffine = 2, kSimilar = 3, kBefore = 3 };
  /// What the values are.
  enum class Of : std::uint8_t { kNumbers, kTexcoords, kChanges };

  FieldOpinions(const PropertyMesh& mesh, const WedgeFans& fans, std::span<const std::uint32_t> partner,
                std::span<const FieldValue> values, Of what)
      : mesh_(mesh),
        fans_(fans),
        partner_(partner),
        values_(values),
        flat_(what == Of::kTexcoords && mesh.shape != nullptr),
        changes_(what == Of::kChanges) {}

  std::size_t count() const { return flat_ || changes_ ? 4 : mesh_.shape == nullptr ? 2 : 3; }

  struct Heard : Opinions<FieldValue::kOpinions, kMaxAttributeComponents> {
    std::array<double, FieldValue::kOpinions> weight{};
    std::array<std::int64_t, kMaxAttributeComponents> sizes{};
    int wings = 0;  ///< parallelograms that the value closes
  };

  /// `last` is the value before, in the order of coding; `change`, where values are changes, the last of this
  /// one.
  Heard of(std::uint32_t wedge, const Value& last, const Value& change) const {
    Heard heard;
    if (changes_) {
      heard.opinion[kBefore] = change;
      heard.weight[kBefore] = 1;
    }
    for (const std::uint32_t corner : fans_.corners(wedge)) hear_face(heard, corner);
    for (std::size_t k = 0; k < count(); ++k) {
      if (!(heard.weight[k] > 0)) continue;
      for (double& x : heard.opinion[k]) x = x / heard.weight[k];
    }
    if (!(heard.weight[kMean] > 0)) heard.opinion[kMean] = last;
    if (!(heard.weight[kParallelogram] > 0))
      heard.opinion[kParallelogram] = heard.opinion[flat_ && heard.weight[kSimilar] > 0 ? kSimilar : kMean];
    for (std::size_t k = kAffine; k < count(); ++k) {
      if (!(heard.weight[k] > 0)) heard.opinion[k] = heard.opinion[kParallelogram];
    }
    return heard;
  }

  /// Learns which way round texture coordinates lie on the surface, once a value is known.
  void learn(std::uint32_t wedge) {
    if (!flat_) return;
    for (const std::uint32_t corner : fans_.corners(wedge)) {
      const FieldValue &n = at(next_corner(corner)), &p = at(previous_corner(corner));
      if (!n.known || !p.known) continue;
      const double area = area_of(n.value, p.value, values_[wedge].value);
      if (area != 0) turn_ = std::clamp(turn_ + (area > 0 ? 1 : -1), -4, 4);
    }
  }

 private:
  const FieldValue& at(std::uint32_t corner) const { return values_[fans_.of(corner)]; }

  /// Of the triangle n, p, x, twice; above 0 where it is counter-clockwise.
  static double area_of(const Value& n, const Value& p, const Value& x) {
    return (p[0] - n[0]) * (x[1] - n[1]) - (p[1] - n[1]) * (x[0] - n[0]);
  }

  static void say(Heard& heard, Opinion who, const Value& value, double weight) {
    for (std::size_t c = 0; c < value.size(); ++c)
      heard.opinion[who][c] = heard.opinion[who][c] + weight * value[c];
    heard.weight[who] = heard.weight[who] + weight;
  }

  void hear_neighbour(Heard& heard, std::uint32_t corner, std::uint32_t other) const {
    const FieldValue& u = at(other);
    if (!u.known) return;
    ++heard.near;
    for (std::size_t k = 0; k < count(); ++k) heard.missed[k] = heard.missed[k] + u.missed[k];
    for (std::size_t c = 0; c < heard.sizes.size(); ++c) heard.sizes[c] += u.size[c];
    double weight = 1;
    if (mesh_.shape != nullptr) {
      const Vector d = minus(place_of(mesh_, other), place_of(mesh_, corner));
      weight = 1 / std::sqrt(dot(d, d) + 1);
    }
    say(heard, kMean, u.value, weight);
  }

  /// The corner across the edge that lies opposite this one, whose value is known, where no seam is between.
  std::uint32_t across(std::uint32_t corner) const {
    const std::uint32_t nc = next_corner(corner), pc = previous_corner(corner), back = partner_[nc];
    if (back == kNoCorner || fans_.of(back) != fans_.of(pc) || fans_.of(next_corner(back)) != fans_.of(nc))
      return kNoCorner;
    return at(previous_corner(back)).known ? previous_corner(back) : kNoCorner;
  }

  void hear_face(Heard& heard, std::uint32_t corner) const {
    const std::uint32_t nc = next_corner(corner), pc = previous_corner(corner);
    hear_neighbour(heard, corner, nc);
    hear_neighbour(heard, corner, pc);
    const FieldValue &n = at(nc), &p = at(pc);
    if (!n.known || !p.known) return;
    const std::uint32_t oc = across(corner);
    if (oc != kNoCorner) {
      ++heard.wings;
      Value value{};
      for (std::size_t c = 0; c < value.size(); ++c) value[c] = n.value[c] + p.value[c] - at(oc).value[c];
      say(heard, kParallelogram, value, 1);
    }
    if (mesh_.shape != nullptr) hear_shape(heard, corner, oc);
  }

  /// Where a corner lies beside the edge from n to p: how far along it, and how far from it, in its lengths.
  struct Beside {
    double along, away;
  };
  static Beside beside(const Vector& edge, double square, const Vector& place) {
    const double along = dot(place, edge) / square;
    return {along, std::sqrt(std::max(0.0, dot(place, place) / square - along * along))};
  }

  void hear_shape(Heard& heard, std::uint32_t corner, std::uint32_t oc) const {
    const std::uint32_t nc = next_corner(corner), pc = previous_corner(corner);
    const Vector base = place_of(mesh_, nc), edge = minus(place_of(mesh_, pc), base);
    const double square = dot(edge, edge);
    if (!(square > 0)) return;
    const Value &n = at(nc).value, &p = at(pc).value;
    const Beside here = beside(edge, square, minus(place_of(mesh_, corner), base));
    bool mirrored = turn_ < 0;
    if (oc != kNoCorner) {
      const Value& o = at(oc).value;
      const Beside there = beside(edge, square, minus(place_of(mesh_, oc), base));
      if (there.away * 8 > here.away) say_affine(heard, n, p, o, here, there);
      const double area = flat_ ? area_of(n, p, o) : 0;
      if (area != 0) mirrored = area > 0;
    }
    if (!flat_) return;
    const double du = p[0] - n[0], dv = p[1] - n[1], away = mirrored ? -here.away : here.away;
    say(heard, kSimilar, {n[0] + here.along * du - away * dv, n[1] + here.along * dv + away * du}, 1);
  }

  /// The affine map of the triangle across, unfolded into this one's plane.
  static void say_affine(Heard& heard, const Value& n, const Value& p, const Value& o, const Beside& here,
                         const Beside& there) {
    const double ratio = here.away / there.away;
    Value value{};
    for (std::size_t c = 0; c < value.size(); ++c) {
      const double d = p[c] - n[c];
      value[c] = n[c] + here.along * d - ratio * (o[c] - n[c] - there.along * d);
    }
    say(heard, kAffine, value, 1 / (1 + ratio));
  }

  const PropertyMesh& mesh_;
  const WedgeFans& fans_;
  std::span<const std::uint32_t> partner_;
  std::span<const FieldValue> values_;  ///< [wedge]
  bool flat_;                           ///< texture coordinates of two numbers over a shape
  bool changes_;                        ///< from one frame to the next
  int turn_ = 0;  ///< below 0 where the texture coordinates met last are mirrored, most of them
};

}  // namespace tvg
