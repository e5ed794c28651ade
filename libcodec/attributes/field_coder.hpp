#pragma once
#include "attributes/attribute_grid.hpp"
#include "attributes/property_mesh.hpp"
#include "attributes/wedge_fans.hpp"
#include "entropy/range_coder.hpp"
#include "planes/shape_models.hpp"
#include "planes/shape_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <memory>

namespace tvg {

/// Codes texture coordinates, colours and generic numbers on a grid.
class FieldCoder {
 public:
  static constexpr std::size_t kExperts = 4;
  using Value = std::array<double, kMaxAttributeComponents>;

  FieldCoder(const PropertyMesh& mesh, const WedgeFans& fans, std::span<const std::uint32_t> partner,
             const AttributeGrid& grid)
      : mesh_(mesh), fans_(fans), partner_(partner), grid_(grid), width_(grid.integers()),
        order_(static_cast<std::uint32_t>(fans.count())), coded_(fans.count()),
        models_(std::make_unique<ShapeModels>()) {
    running_.fill(16 << 8);
    for (auto& c : class_errors_) c.fill(16);
    flat_ = mesh.shape != nullptr && grid.kind == AttributeKind::kTexcoord && width_ == 2;
    experts_ = mesh.shape == nullptr ? 2 : flat_ ? 4 : 3;
  }

  template <class Coder>
  bool code(Coder& coder, std::span<std::int32_t> values) {
    for (std::size_t turn = 0; turn < fans_.count(); ++turn) {
      const std::uint32_t w = order_.next();
      if (!code_wedge(coder, w, values.subspan(width_ * w, width_))) return false;
    }
    return true;
  }

 private:
  struct Coded {
    Value value{};
    std::array<float, kExperts> error{};
    std::array<std::int32_t, kMaxAttributeComponents> size{};
    bool known = false;
  };
  struct Opinions {
    std::array<Value, kExperts> expert{};
    std::array<double, kExperts> weight{};
    std::array<double, kExperts> past{};
    std::array<std::int64_t, kMaxAttributeComponents> sizes{};
    int wings = 0, near = 0;
  };

  void add(Opinions& o, std::size_t k, const Value& v, double weight) const {
    for (std::size_t c = 0; c < width_; ++c) o.expert[k][c] += weight * v[c];
    o.weight[k] += weight;
  }

  std::array<double, 3> place(std::uint32_t corner) const {
    const auto& p = mesh_.shape->indices[mesh_.faces[corner / 3][corner % 3]];
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }
  static double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  static std::array<double, 3> minus(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }

  void look(Opinions& o, std::uint32_t corner, std::uint32_t other) const {
    const Coded& u = coded_[fans_.of(other)];
    if (!u.known) return;
    ++o.near;
    for (std::size_t k = 0; k < experts_; ++k) o.past[k] += static_cast<double>(u.error[k]);
    for (std::size_t c = 0; c < width_; ++c) o.sizes[c] += u.size[c];
    double weight = 1;
    if (mesh_.shape != nullptr) {
      const auto d = minus(place(other), place(corner));
      weight = 1 / std::sqrt(dot(d, d) + 1);
    }
    add(o, 1, u.value, weight);
  }

  void face(Opinions& o, std::uint32_t corner) const {
    const std::uint32_t nc = next_corner(corner), pc = previous_corner(corner);
    look(o, corner, nc);
    look(o, corner, pc);
    const Coded &n = coded_[fans_.of(nc)], &p = coded_[fans_.of(pc)];
    if (!n.known || !p.known) return;
    const std::uint32_t back = partner_[nc];
    const Coded* across = nullptr;
    std::uint32_t oc = 0;
    if (back != kNoCorner && fans_.of(back) == fans_.of(pc) && fans_.of(next_corner(back)) == fans_.of(nc)) {
      oc = previous_corner(back);
      across = &coded_[fans_.of(oc)];
      if (!across->known) across = nullptr;
    }
    if (across != nullptr) {
      ++o.wings;
      Value v{};
      for (std::size_t c = 0; c < width_; ++c) v[c] = n.value[c] + p.value[c] - across->value[c];
      add(o, 0, v, 1);
    }
    if (mesh_.shape == nullptr) return;
    const auto base = place(nc), e = minus(place(pc), base), r = minus(place(corner), base);
    const double L = dot(e, e);
    if (!(L > 0)) return;
    const double a = dot(r, e) / L, h = std::sqrt(std::max(0.0, dot(r, r) / L - a * a));
    double side = turn_ < 0 ? -1 : 1;
    if (across != nullptr) {
      const auto s = minus(place(oc), base);
      const double ao = dot(s, e) / L, ho = std::sqrt(std::max(0.0, dot(s, s) / L - ao * ao));
      if (ho * 8 > h) {
        const double ratio = h / ho;
        Value v{};
        for (std::size_t c = 0; c < width_; ++c) {
          const double d = p.value[c] - n.value[c];
          v[c] = n.value[c] + a * d - ratio * (across->value[c] - n.value[c] - ao * d);
        }
        add(o, 2, v, 1 / (1 + ratio));
      }
      if (flat_) {
        const double cross = (p.value[0] - n.value[0]) * (across->value[1] - n.value[1]) -
                             (p.value[1] - n.value[1]) * (across->value[0] - n.value[0]);
        if (cross != 0) side = cross < 0 ? 1 : -1;
      }
    }
    if (flat_) {
      const double du = p.value[0] - n.value[0], dv = p.value[1] - n.value[1];
      add(o, 3, {n.value[0] + a * du - side * h * dv, n.value[1] + a * dv + side * h * du}, 1);
    }
  }

  Opinions opinions(std::uint32_t w) const {
    Opinions o;
    for (const std::uint32_t corner : fans_.corners(w)) face(o, corner);
    for (std::size_t k = 0; k < experts_; ++k) {
      if (o.weight[k] > 0)
        for (std::size_t c = 0; c < width_; ++c) o.expert[k][c] /= o.weight[k];
    }
    if (o.weight[1] == 0) {
      o.expert[1] = last_;
    }
    if (o.weight[0] == 0) o.expert[0] = flat_ && o.weight[3] > 0 ? o.expert[3] : o.expert[1];
    for (std::size_t k = 2; k < experts_; ++k)
      if (o.weight[k] == 0) o.expert[k] = o.expert[0];
    return o;
  }

  template <class Coder>
  bool code_wedge(Coder& coder, std::uint32_t w, std::span<std::int32_t> values) {
    const Opinions o = opinions(w);
    auto& cls = class_errors_[std::min(o.wings, 3)];
    double total = 0;
    Value mixed{};
    std::array<double, kExperts> credit{};
    for (std::size_t k = 0; k < experts_; ++k) {
      const double error = (o.past[k] + cls[k]) / (o.near + 1) + 0.05;
      credit[k] = 1 / (error * error);
      credit[k] *= credit[k];
      total += credit[k];
      for (std::size_t c = 0; c < width_; ++c) mixed[c] += credit[k] * o.expert[k][c];
    }
    Coded& coded = coded_[w];
    std::int64_t others = 0;
    for (std::size_t c = 0; c < width_; ++c) {
      const double p = mixed[c] / total;
      double spread = 0;
      for (std::size_t k = 0; k < experts_; ++k) spread += credit[k] * std::abs(o.expert[k][c] - p);
      spread /= total;
      const double clamped = std::clamp(p, 0.0, static_cast<double>(grid_.largest()));
      const auto predicted = static_cast<std::int32_t>(std::floor(clamped + 0.5));
      const auto lost = static_cast<std::int32_t>((clamped - predicted) * 16);
      const std::int64_t around = o.near > 0 ? (o.sizes[c] << 8) / o.near : running_[c];
      const std::int64_t same = c == 0 ? around : others / static_cast<std::int64_t>(c);
      const auto wide = static_cast<std::int64_t>(std::min(spread, 1e6) * 256);
      const std::int64_t expected = 4 * running_[c] + 5 * around + 4 * same + 3 * wide;
      const ShapeChoice choice = choose(o, lost, wide, expected);
      const std::int32_t residual = models_->code(coder, choice, Coder::kDecoding ? 0 : values[c] - predicted);
      const std::int32_t value = predicted + residual;
      if (value < 0 || value > grid_.largest()) return false;
      if constexpr (Coder::kDecoding) {
        if (coder.overrun()) return false;
        values[c] = value;
      }
      coded.value[c] = value;
      coded.size[c] = std::abs(residual);
      const std::int64_t size = std::int64_t{coded.size[c]} << 8;
      others += size;
      running_[c] += (size - running_[c]) >> 5;
    }
    for (std::size_t k = 0; k < experts_; ++k) {
      double off = 0;
      for (std::size_t c = 0; c < width_; ++c) off += std::abs(coded.value[c] - o.expert[k][c]);
      coded.error[k] = static_cast<float>(off);
      cls[k] += (off - cls[k]) * 0.05;
    }
    coded.known = true;
    last_ = coded.value;
    for (const std::uint32_t corner : fans_.corners(w)) {
      const std::uint32_t nc = next_corner(corner), pc = previous_corner(corner);
      if (!coded_[fans_.of(nc)].known) order_.raise(fans_.of(nc));
      if (!coded_[fans_.of(pc)].known) order_.raise(fans_.of(pc));
      if (flat_ && coded_[fans_.of(nc)].known && coded_[fans_.of(pc)].known) {
        const Value &n = coded_[fans_.of(nc)].value, &p = coded_[fans_.of(pc)].value;
        const double cross = (p[0] - n[0]) * (coded.value[1] - n[1]) - (p[1] - n[1]) * (coded.value[0] - n[0]);
        if (cross != 0) turn_ = std::clamp(turn_ + (cross > 0 ? 1 : -1), -4, 4);
      }
    }
    return true;
  }

  static std::uint32_t thirds(std::uint32_t x) {
    const auto octave = static_cast<std::uint32_t>(std::bit_width(x)) - 1;
    const std::uint64_t rest = (std::uint64_t{x} << 8) >> octave;
    return 3 * octave + (rest >= 323 ? 1 : 0) + (rest >= 406 ? 1 : 0);
  }
  static ShapeChoice choose(const Opinions& o, std::int32_t lost, std::int64_t around, std::int64_t expected) {
    std::int64_t size = (o.wings > 0 ? expected : 2 * expected) >> 4;
    int raw_bits = 0;
    for (; size > 640; size >>= 1) ++raw_bits;
    const std::uint32_t level = thirds(static_cast<std::uint32_t>(std::max<std::int64_t>(size, 5))) - 6;
    const std::int32_t rest = std::abs(lost);
    const auto near = static_cast<std::uint32_t>(std::min<std::int64_t>(around >> raw_bits, std::int64_t{1} << 30));
    return {level, rest >= 6 ? 2u : rest >= 2 ? 1u : 0u, static_cast<std::uint32_t>(std::min(o.wings, 3)),
            near < 77 ? 0 : std::min(15u, 1 + (thirds(near) - 18) / 2), raw_bits, lost < 0};
  }

  const PropertyMesh& mesh_;
  const WedgeFans& fans_;
  std::span<const std::uint32_t> partner_;
  const AttributeGrid& grid_;
  std::size_t width_, experts_;
  bool flat_;
  ShapeOrder order_;
  std::vector<Coded> coded_;
  Value last_{};
  int turn_ = 0;
  std::array<std::int64_t, kMaxAttributeComponents> running_{};
  std::array<std::array<double, kExperts>, 4> class_errors_;
  std::unique_ptr<ShapeModels> models_;
};

}  // namespace tvg
