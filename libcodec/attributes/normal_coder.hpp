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

class NormalCoder {
 public:
  static constexpr std::size_t kExperts = 5;
  using Vector = std::array<double, 3>;

  NormalCoder(const PropertyMesh& mesh, const WedgeFans& fans, const AttributeGrid& grid)
      : mesh_(mesh), fans_(fans), grid_(grid), centre_(grid.largest() / 2),
        order_(static_cast<std::uint32_t>(fans.count())), coded_(fans.count()),
        models_(std::make_unique<ShapeModels>()) {
    running_.fill(16 << 8);
    class_errors_.fill(0.1);
    experts_ = mesh.shape == nullptr ? 1 : kExperts;
    if (mesh.shape != nullptr)
      for (std::uint32_t w = 0; w < coded_.size(); ++w) survey(w);
  }

  template <class Coder>
  bool code(Coder& coder, std::span<std::int32_t> values) {
    for (std::size_t turn = 0; turn < fans_.count(); ++turn) {
      const std::uint32_t w = order_.next();
      if (!code_wedge(coder, w, values.subspan(2 * w, 2))) return false;
    }
    return true;
  }

 private:
  struct Coded {
    std::array<Vector, 3> shape{};  ///< area, unit, sharp
    Vector value{};
    std::array<float, kExperts> error{};
    std::array<std::int32_t, 2> size{};
    bool known = false;
  };
  struct Opinions {
    std::array<Vector, kExperts> expert{};
    std::array<double, kExperts> past{};
    std::array<std::int64_t, 2> sizes{};
    int near = 0;
  };

  static double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  static void add(Vector& a, const Vector& b, double s) {
    for (std::size_t i = 0; i < 3; ++i) a[i] += s * b[i];
  }
  static Vector unit(const Vector& a) {
    const double length = std::sqrt(dot(a, a));
    if (!(length > 0)) return {0, 0, 0};
    return {a[0] / length, a[1] / length, a[2] / length};
  }
  Vector place(std::uint32_t corner) const {
    const auto& p = mesh_.shape->indices[mesh_.faces[corner / 3][corner % 3]];
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }

  void survey(std::uint32_t w) {
    auto& s = coded_[w].shape;
    for (const std::uint32_t corner : fans_.corners(w)) {
      const Vector here = place(corner), a = minus(place(next_corner(corner)), here),
                   b = minus(place(previous_corner(corner)), here);
      const Vector n = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
      const double area = std::sqrt(dot(n, n)), aa = dot(a, a), bb = dot(b, b);
      if (!(area > 0)) continue;
      add(s[0], n, 1);
      add(s[1], n, 1 / area);
      add(s[2], n, 1 / (aa * bb));
    }
    for (Vector& v : s) v = unit(v);
  }

  void look(Opinions& o, std::uint32_t other) const {
    const Coded& u = coded_[fans_.of(other)];
    if (!u.known) return;
    ++o.near;
    for (std::size_t k = 0; k < experts_; ++k) o.past[k] += static_cast<double>(u.error[k]);
    for (std::size_t c = 0; c < 2; ++c) o.sizes[c] += u.size[c];
    add(o.expert[0], u.value, 1);
    add(o.expert[4], minus(u.value, u.shape[2]), 1);
  }

  Opinions opinions(std::uint32_t w) const {
    Opinions o;
    for (const std::uint32_t corner : fans_.corners(w)) {
      look(o, next_corner(corner));
      look(o, previous_corner(corner));
    }
    const auto& shape = coded_[w].shape;
    o.expert[0] = o.near > 0 ? unit(o.expert[0]) : last_;
    o.expert[1] = shape[0];
    o.expert[2] = shape[1];
    o.expert[3] = shape[2];
    Vector corrected = shape[2];
    if (o.near > 0) add(corrected, o.expert[4], 1.0 / o.near);
    o.expert[4] = unit(corrected);
    return o;
  }

  std::array<double, 2> fold(const Vector& n) const {
    const double sum = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
    if (!(sum > 0)) return {0, 0};
    const double y = n[1] / sum * centre_, z = n[2] / sum * centre_;
    return {y, z};
  }
  std::array<std::int32_t, 2> flipped(std::int32_t y, std::int32_t z) const {
    return {y < 0 ? std::abs(z) - centre_ : centre_ - std::abs(z), z < 0 ? std::abs(y) - centre_ : centre_ - std::abs(y)};
  }

  template <class Coder>
  bool code_wedge(Coder& coder, std::uint32_t w, std::span<std::int32_t> values) {
    const Opinions o = opinions(w);
    double total = 0;
    Vector mixed{};
    std::array<double, kExperts> credit{};
    for (std::size_t k = 0; k < experts_; ++k) {
      const double error = (o.past[k] + class_errors_[k]) / (o.near + 1) + 0.0002;
      credit[k] = 1 / (error * error);
      credit[k] *= credit[k];
      total += credit[k];
      add(mixed, o.expert[k], credit[k]);
    }
    double spread = 0;
    for (auto& x : mixed) x /= total;
    for (std::size_t k = 0; k < experts_; ++k) {
      const Vector d = minus(o.expert[k], mixed);
      spread += credit[k] * (std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]));
    }
    spread = spread / total * centre_ * 0.5;
    const bool turned = mixed[0] < 0;
    const auto place = fold(mixed);
    Coded& coded = coded_[w];
    std::array<std::int32_t, 2> actual{};
    const bool none = coder.code(none_, !Coder::kDecoding && values[0] == grid_.none());
    if (!Coder::kDecoding && !none) {
      actual = {values[0] - centre_, values[1] - centre_};
      if (turned) actual = flipped(actual[0], actual[1]);
    }
    std::int64_t others = 0;
    for (std::size_t c = 0; c < 2 && !none; ++c) {
      const auto predicted = static_cast<std::int32_t>(std::floor(place[c] + 0.5));
      const auto lost = static_cast<std::int32_t>((place[c] - predicted) * 16);
      const std::int64_t around = o.near > 0 ? (o.sizes[c] << 8) / o.near : running_[c];
      const std::int64_t same = c == 0 ? around : others;
      const auto wide = static_cast<std::int64_t>(std::min(spread, 1e6) * 256);
      const std::int64_t expected = 4 * running_[c] + 5 * around + 4 * same + 3 * wide;
      const ShapeChoice choice = choose(o, lost, wide, expected);
      std::int32_t residual = actual[c] - predicted;
      if (residual > centre_) residual -= 2 * centre_ + 1;
      if (residual < -centre_) residual += 2 * centre_ + 1;
      residual = models_->code(coder, choice, residual);
      if (residual > centre_ || residual < -centre_) return false;
      actual[c] = predicted + residual;
      if (actual[c] > centre_) actual[c] -= 2 * centre_ + 1;
      if (actual[c] < -centre_) actual[c] += 2 * centre_ + 1;
      coded.size[c] = std::abs(residual);
      const std::int64_t size = std::int64_t{coded.size[c]} << 8;
      others += size;
      running_[c] += (size - running_[c]) >> 5;
    }
    if constexpr (Coder::kDecoding) {
      if (coder.overrun()) return false;
      if (none) {
        values[0] = values[1] = grid_.none();
      } else {
        if (turned) actual = flipped(actual[0], actual[1]);
        values[0] = actual[0] + centre_;
        values[1] = actual[1] + centre_;
      }
    }
    std::array<float, 3> value{};
    grid_.value_of(values, value);
    coded.value = {static_cast<double>(value[0]), static_cast<double>(value[1]), static_cast<double>(value[2])};
    for (std::size_t k = 0; k < experts_; ++k) {
      const Vector d = minus(coded.value, o.expert[k]);
      const double off = std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]);
      coded.error[k] = static_cast<float>(off);
      class_errors_[k] += (off - class_errors_[k]) * 0.05;
    }
    coded.known = true;
    last_ = coded.value;
    for (const std::uint32_t corner : fans_.corners(w)) {
      for (const std::uint32_t other : {next_corner(corner), previous_corner(corner)})
        if (!coded_[fans_.of(other)].known) order_.raise(fans_.of(other));
    }
    return true;
  }

  static std::uint32_t thirds(std::uint32_t x) {
    const auto octave = static_cast<std::uint32_t>(std::bit_width(x)) - 1;
    const std::uint64_t rest = (std::uint64_t{x} << 8) >> octave;
    return 3 * octave + (rest >= 323 ? 1 : 0) + (rest >= 406 ? 1 : 0);
  }
  static ShapeChoice choose(const Opinions& o, std::int32_t lost, std::int64_t around, std::int64_t expected) {
    std::int64_t size = expected >> 4;
    int raw_bits = 0;
    for (; size > 640; size >>= 1) ++raw_bits;
    const std::uint32_t level = thirds(static_cast<std::uint32_t>(std::max<std::int64_t>(size, 5))) - 6;
    const std::int32_t rest = std::abs(lost);
    const auto near = static_cast<std::uint32_t>(std::min<std::int64_t>(around >> raw_bits, std::int64_t{1} << 30));
    return {level, rest >= 6 ? 2u : rest >= 2 ? 1u : 0u, static_cast<std::uint32_t>(std::min(o.near, 3)),
            near < 77 ? 0 : std::min(15u, 1 + (thirds(near) - 18) / 2), raw_bits, lost < 0};
  }

  const PropertyMesh& mesh_;
  const WedgeFans& fans_;
  const AttributeGrid& grid_;
  std::int32_t centre_;
  std::size_t experts_;
  ShapeOrder order_;
  std::vector<Coded> coded_;
  Vector last_{1, 0, 0};
  AdaptiveBit none_;
  std::array<std::int64_t, 2> running_{};
  std::array<double, kExperts> class_errors_;
  std::unique_ptr<ShapeModels> models_;
};

}  // namespace tvg
