#pragma once
#include "attributes/field_opinions.hpp"
#include "attributes/frame_history.hpp"
#include "attributes/residual_coder.hpp"
#include "planes/shape_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// What coding fields learns.
struct FieldModels {
  explicit FieldModels(const AttributeGrid& grid) {
    for (auto& misses : usual) misses.fill(grid.stepped() ? 16 : 0);
  }

  std::array<std::array<double, FieldValue::kOpinions>, 4> usual{};  ///< [kind][opinion]
  GridResiduals grid_residuals;
  ExactResiduals exact_residuals;
};

/// Codes texture coordinates, colours and numbers, and normals that are exact (format-spec §5.7.4), or how
/// they change from frame to frame (§5.7.7).
class FieldCoder {
 public:
  /// What it takes for each value and each of their corners, in bytes.
  static constexpr std::size_t kBytesPerValue = sizeof(FieldValue) + ShapeOrder::kBytesPerVertex;

  FieldCoder(const PropertyMesh& mesh, const WedgeFans& fans, std::span<const std::uint32_t> partner,
             const AttributeGrid& grid, FieldModels& models, const FrameHistory& history = {})
      : fans_(fans),
        grid_(grid),
        models_(models),
        history_(history),
        width_(grid.integers()),
        order_(static_cast<std::uint32_t>(fans.count())),
        values_(fans.count()),
        opinions_(mesh, fans, partner, values_,
                  !history.before.empty()                                ? FieldOpinions::Of::kChanges
                  : grid.kind == AttributeKind::kTexcoord && width_ == 2 ? FieldOpinions::Of::kTexcoords
                                                                         : FieldOpinions::Of::kNumbers) {}

  /// The integers of all values, [wedge][integer]; false where the stream is malformed.
  template <class Coder>
  bool code(Coder& coder, std::span<std::int32_t> integers) {
    for (std::size_t turn = 0; turn < fans_.count(); ++turn) {
      const std::uint32_t w = order_.next();
      if (!code_value(coder, w, integers.subspan(width_ * w, width_))) return false;
      for (const std::uint32_t corner : fans_.corners(w)) {
        for (const std::uint32_t other : {next_corner(corner), previous_corner(corner)})
          if (!values_[fans_.of(other)].known) order_.raise(fans_.of(other));
      }
      opinions_.learn(w);
    }
    return true;
  }

 private:
  template <class Coder>
  bool code_value(Coder& coder, std::uint32_t w, std::span<std::int32_t> integers) {
    if (!history_.before.empty()) recall(w);
    FieldOpinions::Heard heard = opinions_.of(w, last_, change_);
    const std::size_t count = opinions_.count();
    std::array<double, FieldValue::kOpinions>& usual =
        models_.usual[static_cast<std::size_t>(kind_of(heard))];
    const FieldOpinions::Value mixed = heard.mixed(usual, grid_.stepped() ? 0.05 : 0x1p-100, count);
    models_.grid_residuals.begin_value();
    models_.exact_residuals.begin_value();
    FieldValue& coded = values_[w];
    for (std::size_t c = 0; c < width_; ++c) {
      const bool valid = grid_.stepped() ? code_step(coder, c, heard, mixed[c], integers[c], coded)
                                         : code_exact(coder, c, heard, mixed[c], integers[c], coded);
      if (!valid) return false;
    }
    for (std::size_t k = 0; k < count; ++k) {
      double missed = 0;
      for (std::size_t c = 0; c < width_; ++c)
        missed = missed + std::abs(coded.value[c] - heard.opinion[k][c]);
      coded.missed[k] = missed;
      usual[k] = usual[k] + (missed - usual[k]) * 0.05;
    }
    coded.known = true;
    last_ = coded.value;
    if constexpr (Coder::kDecoding) return !coder.overrun();
    return true;
  }

  static int kind_of(const FieldOpinions::Heard& heard) { return std::min(heard.wings, 3); }

  double number_of(std::int32_t integer) const {
    return grid_.stepped() ? integer : static_cast<double>(ordered_number(integer));
  }

  /// What value w was in the frame before, and how it changed there.
  void recall(std::uint32_t w) {
    for (std::size_t c = 0; c < width_; ++c) {
      const std::size_t i = width_ * w + c;
      base_[c] = number_of(history_.before[i]);
      change_[c] = history_.older.empty() ? 0 : base_[c] - number_of(history_.older[i]);
    }
  }

  /// The number that a prediction stands for, and the value that a number has.
  double number_at(std::size_t c, double mixed) const {
    return history_.before.empty() ? mixed : base_[c] + mixed;
  }
  double value_at(std::size_t c, double number) const {
    return history_.before.empty() ? number : number - base_[c];
  }

  template <class Coder>
  bool code_step(Coder& coder, std::size_t c, const FieldOpinions::Heard& heard, double mixed,
                 std::int32_t& integer, FieldValue& coded) {
    const double place = std::clamp(number_at(c, mixed), 0.0, static_cast<double>(grid_.largest()));
    const auto predicted = static_cast<std::int32_t>(std::floor(place + 0.5));
    double spread = 0;
    for (std::size_t k = 0; k < opinions_.count(); ++k)
      spread = spread + heard.credit[k] * std::abs(heard.opinion[k][c] - mixed);
    const std::int32_t residual =
        models_.grid_residuals.code(coder, c,
                                    {heard.sizes[c], heard.near, kind_of(heard), heard.wings == 0, spread,
                                     static_cast<std::int32_t>((place - predicted) * 16)},
                                    Coder::kDecoding ? 0 : integer - predicted);
    const std::int32_t found = predicted + residual;
    if (found < 0 || found > grid_.largest()) return false;
    if constexpr (Coder::kDecoding) integer = found;
    coded.value[c] = value_at(c, found);
    coded.size[c] = std::abs(residual);
    return true;
  }

  template <class Coder>
  bool code_exact(Coder& coder, std::size_t c, const FieldOpinions::Heard& heard, double mixed,
                  std::int32_t& integer, FieldValue& coded) {
    const auto predicted = static_cast<std::uint32_t>(ordered_integer(finite_float(number_at(c, mixed))));
    const std::uint32_t wanted = static_cast<std::uint32_t>(integer) - predicted;
    const std::int32_t residual =
        models_.exact_residuals.code(coder, {heard.sizes[c], heard.near}, static_cast<std::int32_t>(wanted));
    const auto found = static_cast<std::int32_t>(predicted + static_cast<std::uint32_t>(residual));
    if (!is_finite_number(found)) return false;
    if constexpr (Coder::kDecoding) integer = found;
    coded.value[c] = value_at(c, static_cast<double>(ordered_number(found)));
    coded.size[c] = ExactResiduals::size_of(residual);
    return true;
  }

  const WedgeFans& fans_;
  const AttributeGrid& grid_;
  FieldModels& models_;
  FrameHistory history_;
  std::size_t width_;
  ShapeOrder order_;
  std::vector<FieldValue> values_;  ///< [wedge]
  FieldOpinions opinions_;
  FieldOpinions::Value last_{};
  FieldOpinions::Value base_{};    ///< of the value being coded: what it was in the frame before
  FieldOpinions::Value change_{};  ///< and how it changed there
};

}  // namespace tvg
