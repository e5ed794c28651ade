#pragma once
#include "attributes/attribute_grid.hpp"
#include "attributes/frame_history.hpp"
#include "attributes/opinions.hpp"
#include "attributes/residual_coder.hpp"
#include "attributes/surface_vectors.hpp"
#include "attributes/wedge_fans.hpp"
#include "planes/shape_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

namespace tvg {

/// What coding normals learns.
struct NormalModels {
  static constexpr std::size_t kOpinions = 5;

  NormalModels() { usual.fill(0.1); }

  std::array<double, kOpinions> usual{};
  std::array<AdaptiveBit, 2> none;  ///< [whether there was none in the frame before]
  GridResiduals residuals;
};

/// Codes normals on the octahedron (format-spec §5.7.5), also by those of frames before (§5.7.7).
class NormalCoder {
  static constexpr std::size_t kOpinions = NormalModels::kOpinions;
  static constexpr std::size_t kOpinionsOverTime = 3;

  /// What is known of a normal.
  struct Normal {
    /// That of the reference shape, small faces counting as much as large ones; or that of the frame before.
    Vector surface{};
    Vector value{};
    std::array<double, kOpinions> missed{};  ///< by how much each opinion missed it
    std::array<std::int32_t, 2> size{};      ///< of its residuals
    bool known = false;
  };

 public:
  static constexpr std::size_t kBytesPerValue = sizeof(Normal) + ShapeOrder::kBytesPerVertex;

  NormalCoder(const PropertyMesh& mesh, const WedgeFans& fans, const AttributeGrid& grid,
              NormalModels& models, const FrameHistory& history = {})
      : mesh_(mesh),
        fans_(fans),
        grid_(grid),
        models_(models),
        history_(history),
        centre_(grid.largest() / 2),
        count_(over_time()             ? kOpinionsOverTime
               : mesh.shape == nullptr ? 1
                                       : kOpinions),
        order_(static_cast<std::uint32_t>(fans.count())),
        normals_(fans.count()) {
    for (std::uint32_t w = 0; over_time() && w < normals_.size(); ++w)
      normals_[w].surface = normal_of(history_.before.subspan(2 * w, 2));
    for (std::uint32_t w = 0; !over_time() && mesh.shape != nullptr && w < normals_.size(); ++w)
      normals_[w].surface = surface_normals(w)[2];
  }

  /// The integers of all normals, [wedge][2]; false where the stream is malformed.
  template <class Coder>
  bool code(Coder& coder, std::span<std::int32_t> integers) {
    for (std::size_t turn = 0; turn < fans_.count(); ++turn) {
      const std::uint32_t w = order_.next();
      if (!code_normal(coder, w, integers.subspan(2 * w, 2))) return false;
      for (const std::uint32_t corner : fans_.corners(w)) {
        for (const std::uint32_t other : {next_corner(corner), previous_corner(corner)})
          if (!normals_[fans_.of(other)].known) order_.raise(fans_.of(other));
      }
    }
    return true;
  }

 private:
  struct Heard : Opinions<kOpinions, 3> {
    std::array<std::int64_t, 2> sizes{};
  };
  /// Coordinates of the octahedron, from its middle.
  using Place = std::array<std::int32_t, 2>;

  bool over_time() const { return !history_.before.empty(); }

  Vector normal_of(std::span<const std::int32_t> integers) const {
    std::array<float, 3> value{};
    grid_.value_of(integers, value);
    return {static_cast<double>(value[0]), static_cast<double>(value[1]), static_cast<double>(value[2])};
  }

  /// Normals of the shape, of length 1: faces counted by their area, each as one, and by how sharp they are.
  std::array<Vector, 3> surface_normals(std::uint32_t wedge) const {
    std::array<Vector, 3> sums{};
    for (const std::uint32_t corner : fans_.corners(wedge)) {
      const Vector here = place_of(mesh_, corner);
      const Vector a = minus(place_of(mesh_, next_corner(corner)), here);
      const Vector b = minus(place_of(mesh_, previous_corner(corner)), here);
      const Vector n = cross(a, b);
      const double area = std::sqrt(dot(n, n));
      if (!(area > 0)) continue;
      add(sums[0], n, 1);
      add(sums[1], n, 1 / area);
      add(sums[2], n, 1 / (dot(a, a) * dot(b, b)));
    }
    for (Vector& sum : sums) sum = unit(sum);
    return sums;
  }

  Heard opinions(std::uint32_t wedge) const {
    Heard heard;
    Vector beside{}, off{};
    for (const std::uint32_t corner : fans_.corners(wedge)) {
      for (const std::uint32_t other : {next_corner(corner), previous_corner(corner)}) {
        const Normal& u = normals_[fans_.of(other)];
        if (!u.known) continue;
        ++heard.near;
        for (std::size_t k = 0; k < count_; ++k) heard.missed[k] = heard.missed[k] + u.missed[k];
        for (std::size_t c = 0; c < 2; ++c) heard.sizes[c] += u.size[c];
        add(beside, u.value, 1);
        add(off, minus(u.value, u.surface), 1);
      }
    }
    if (over_time()) {
      hear_frames(heard, wedge, off);
      return heard;
    }
    heard.opinion[0] = heard.near > 0 ? unit(beside) : last_;
    if (mesh_.shape == nullptr) return heard;
    const std::array<Vector, 3> surface = surface_normals(wedge);
    std::copy(surface.begin(), surface.end(), heard.opinion.begin() + 1);
    Vector corrected = surface[2];
    if (heard.near > 0) add(corrected, off, 1.0 / heard.near);
    heard.opinion[4] = unit(corrected);
    return heard;
  }

  /// What the frames before say, where what lies beside has changed by `off`.
  void hear_frames(Heard& heard, std::uint32_t wedge, const Vector& off) const {
    const Vector& before = normals_[wedge].surface;
    heard.opinion[0] = heard.opinion[1] = heard.opinion[2] = before;
    if (heard.near > 0) {
      add(heard.opinion[1], off, 1.0 / heard.near);
      heard.opinion[1] = unit(heard.opinion[1]);
    }
    if (history_.older.empty()) return;
    add(heard.opinion[2], minus(before, normal_of(history_.older.subspan(2 * wedge, 2))), 1);
    heard.opinion[2] = unit(heard.opinion[2]);
  }

  template <class Coder>
  bool code_normal(Coder& coder, std::uint32_t w, std::span<std::int32_t> integers) {
    Heard heard = opinions(w);
    const Vector mixed = heard.mixed(models_.usual, 0.0002, count_);
    Normal& coded = normals_[w];
    const bool none_before = over_time() && history_.before[2 * w] == grid_.none();
    if (coder.code(models_.none[none_before ? 1 : 0], !Coder::kDecoding && integers[0] == grid_.none())) {
      if constexpr (Coder::kDecoding) integers[0] = integers[1] = grid_.none();
    } else if (!code_place(coder, heard, mixed, integers, coded)) {
      return false;
    }
    coded.value = normal_of(integers);
    for (std::size_t k = 0; k < count_; ++k) {
      coded.missed[k] = distance(coded.value, heard.opinion[k]);
      models_.usual[k] = models_.usual[k] + (coded.missed[k] - models_.usual[k]) * 0.05;
    }
    coded.known = true;
    last_ = coded.value;
    if constexpr (Coder::kDecoding) return !coder.overrun();
    return true;
  }

  /// Both normals, the one predicted and this one, are mirrored where the first has x < 0: what lies near
  /// each other on the sphere then does so on the unfolded octahedron.
  template <class Coder>
  bool code_place(Coder& coder, const Heard& heard, const Vector& mixed, std::span<std::int32_t> integers,
                  Normal& coded) {
    const bool mirror = mixed[0] < 0;
    Place place{};
    if constexpr (!Coder::kDecoding) {
      place = {integers[0] - centre_, integers[1] - centre_};
      if (mirror) place = mirrored(place);
    }
    const double sum = std::abs(mixed[0]) + std::abs(mixed[1]) + std::abs(mixed[2]);
    double spread = 0;
    for (std::size_t k = 0; k < count_; ++k)
      spread = spread + heard.credit[k] * distance(heard.opinion[k], mixed);
    models_.residuals.begin_value();
    for (std::size_t c = 0; c < 2; ++c) {
      const double exact = sum > 0 ? mixed[c + 1] / sum * centre_ : 0;
      const auto predicted = static_cast<std::int32_t>(std::floor(exact + 0.5));
      const std::int32_t residual = models_.residuals.code(
          coder, c,
          {heard.sizes[c], heard.near, std::min(heard.near, 3), false, spread * (0.5 * centre_),
           static_cast<std::int32_t>((exact - predicted) * 16)},
          wrapped(place[c] - predicted));
      if (std::abs(residual) > centre_) return false;
      place[c] = wrapped(predicted + residual);
      coded.size[c] = std::abs(residual);
    }
    if constexpr (Coder::kDecoding) {
      if (mirror) place = mirrored(place);
      for (std::size_t c = 0; c < 2; ++c) integers[c] = place[c] + centre_;
    }
    return true;
  }

  /// The coordinate that this is one of, modulo their number.
  std::int32_t wrapped(std::int32_t x) const {
    const std::int32_t period = 2 * centre_ + 1;
    return x > centre_ ? x - period : x < -centre_ ? x + period : x;
  }

  /// The place of the same normal with the sign of x turned.
  Place mirrored(const Place& place) const {
    const std::int32_t y = centre_ - std::abs(place[1]), z = centre_ - std::abs(place[0]);
    return {place[0] < 0 ? -y : y, place[1] < 0 ? -z : z};
  }

  const PropertyMesh& mesh_;
  const WedgeFans& fans_;
  const AttributeGrid& grid_;
  NormalModels& models_;
  FrameHistory history_;
  std::int32_t centre_;
  std::size_t count_;  ///< of opinions
  ShapeOrder order_;
  std::vector<Normal> normals_;  ///< [wedge]
  Vector last_{1, 0, 0};
};

}  // namespace tvg
