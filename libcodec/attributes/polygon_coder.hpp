#pragma once
#include "attributes/edge_pairs.hpp"
#include "attributes/polygons.hpp"
#include "attributes/property_mesh.hpp"
#include "entropy/range_coder.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// The coding of polygons (format-spec §5.9), written once for encoder and decoder.
namespace tvg {

/// How the first face of a fan, in the order of the traversal, belongs to it. 0: it is a triangle by itself.
/// 1 + 2 i: it is the last of the fan, and the one before it lies across its half-edge i, which begins at the
/// fan's first corner. 2 + 2 i: one follows, which lies across its half-edge i, which ends there.
inline constexpr int kFanStarts = 7;

/// The first corner of a fan in the face that follows the one in which it is `apex`, or in the one before;
/// kNoCorner where there is none.
inline std::uint32_t fan_neighbour(std::span<const std::uint32_t> partner, std::uint32_t apex,
                                   bool following) {
  const std::uint32_t back = partner[following ? previous_corner(apex) : apex];
  if (back == kNoCorner) return kNoCorner;
  return following ? back : next_corner(back);
}

/// Codes the fans of a mesh. `Guide` knows them when encoding and nothing when decoding.
template <class Guide>
class PolygonCoder {
 public:
  /// `partner` is what pair_edges() gives.
  PolygonCoder(const PropertyMesh& mesh, std::span<const std::uint32_t> partner, Guide& guide)
      : partner_(partner), guide_(guide), face_count_(mesh.faces.size()), roles_(partner.size(), kUnknown) {}

  /// Codes all into `fans`, which are empty; false where the stream is malformed.
  template <class Coder>
  bool code(Coder& coder, FaceFans& fans) {
    for (std::uint32_t face = 0; face < face_count_; ++face) {
      if (roles_[3 * std::size_t{face}] != kUnknown) continue;
      if (!code_fan(coder, face)) return false;
      take_fan(fans);
      if constexpr (Coder::kDecoding) {
        if (coder.overrun()) return false;
      }
    }
    return true;
  }

 private:
  /// What a half-edge is, of a face that is in a fan or is not yet. The last four are those of a polygon: its
  /// first side, its second, those between and the last. Diagonals have one of them, too: nothing asks.
  enum Role : std::uint8_t { kNone, kUnknown, kTriangle, kFirst, kSecond, kBetween, kLast };
  static constexpr std::size_t kRoles = 7, kKinds = 3, kLengths = 8;

  template <class Coder>
  bool code_fan(Coder& coder, std::uint32_t face) {
    const std::size_t gate = across(3 * face), left = across(3 * face + 1), right = across(3 * face + 2);
    AdaptiveSymbol& coarse = coarse_[(gate * kKinds + kind(left)) * kKinds + kind(right)];
    AdaptiveSymbol& fine = fine_[(gate * kRoles + left) * kRoles + right];
    const std::uint32_t start = coder.code(coarse, fine, guide_.start(face));
    if (start >= kFanStarts) return false;
    before_.clear();
    after_.clear();
    const std::uint32_t half_edge = 3 * face + (std::max(start, 1u) - 1) / 2;
    const bool followed = start > 0 && start % 2 == 0;
    add(followed ? next_corner(half_edge) : half_edge, after_);
    if (start == 0) return true;
    if (followed && !grow(coder, true, 1)) return false;
    return grow(coder, false, followed ? 0 : 1);
  }

  /// Adds the faces on one side of the fan, the first `given` of them without a question.
  template <class Coder>
  bool grow(Coder& coder, bool following, std::size_t given) {
    std::vector<std::uint32_t>& side = following ? after_ : before_;
    for (std::uint32_t apex = after_.front();; apex = side.back()) {
      const std::uint32_t next = fan_neighbour(partner_, apex, following);
      if (next == kNoCorner || roles_[next] != kUnknown) return given == 0;
      AdaptiveBit& model =
          goes_on_[following ? 1 : 0][std::min(before_.size() + after_.size(), kLengths) - 1];
      if (given > 0) {
        --given;
      } else if (!coder.code(model, guide_.goes_on(apex, following))) {
        return true;
      }
      add(next, side);
      if constexpr (Coder::kDecoding) {
        if (coder.overrun()) return false;
      }
    }
  }

  void add(std::uint32_t apex, std::vector<std::uint32_t>& side) {
    side.push_back(apex);
    std::fill_n(roles_.begin() + apex / 3 * 3, 3, kTriangle);
  }

  void take_fan(FaceFans& fans) {
    const std::size_t begin = fans.first_corners.size();
    fans.first_corners.insert(fans.first_corners.end(), before_.rbegin(), before_.rend());
    fans.first_corners.insert(fans.first_corners.end(), after_.begin(), after_.end());
    const std::span<const std::uint32_t> fan = std::span(fans.first_corners).subspan(begin);
    if (fan.size() == 1) return;
    fans.polygons.push_back({begin, static_cast<std::uint32_t>(fan.size() + 2)});
    for (const std::uint32_t apex : fan) {
      roles_[apex] = kFirst;
      roles_[next_corner(apex)] = apex == fan.front() ? kSecond : kBetween;
      roles_[previous_corner(apex)] = kLast;
    }
  }

  /// What the half-edge is that runs back.
  std::size_t across(std::uint32_t half_edge) const {
    const std::uint32_t back = partner_[half_edge];
    return back == kNoCorner ? std::size_t{kNone} : roles_[back];
  }
  static std::size_t kind(std::size_t role) { return std::min<std::size_t>(role, kKinds - 1); }

  std::span<const std::uint32_t> partner_;
  Guide& guide_;
  std::size_t face_count_;
  std::vector<std::uint8_t> roles_;            ///< [half-edge]
  std::vector<std::uint32_t> before_, after_;  ///< first corners of the fan being coded, from its first face
  std::vector<AdaptiveSymbol> coarse_{kRoles * kKinds * kKinds, AdaptiveSymbol(kFanStarts)};
  std::vector<AdaptiveSymbol> fine_{kRoles * kRoles * kRoles, AdaptiveSymbol(kFanStarts)};
  std::array<std::array<AdaptiveBit, kLengths>, 2> goes_on_;
};

}  // namespace tvg
