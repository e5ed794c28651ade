#include "modes/basis_decode.hpp"

#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "entropy/range_coder.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace tvg {

namespace {

/// Calls `use(block, first vertex, vertices)` for each block of a frame's sums.
template <class Use>
void for_each_block(const CoefficientPlanes& planes, const BasisSums& sums, const Use& use) {
  BasisSums::SumBlock block_sums;
  for (std::size_t block = 0; block < planes.block_count(); ++block) {
    sums.sum(planes, block, block_sums);
    const std::size_t first = block * CoefficientPlanes::kAtOnce;
    use(block_sums, first, std::min(CoefficientPlanes::kAtOnce, planes.vertex_count() - first));
  }
}

}  // namespace

GopInfo basis_gop_info(const GopHeader& header, const BasisHeader& basis) {
  GopInfo info = gop_info_of(header, Mode::kBasis);
  info.predictors[static_cast<std::size_t>(Predictor::kRows)] = true;
  info.components = basis.components;
  info.fine_bits = basis.fine_bits;
  info.coarse_bits = basis.coarse_bits;
  info.origin = basis.origin;
  info.step = basis.step;
  return info;
}

// format-spec §4.5.1
Status BasisDecoder::begin(const GopHeader& header, std::shared_ptr<const BasisPlan> plan) {
  ByteReader reader(header.fields);
  if (const Fault fault = read_channels(reader, channels_)) return error_of(fault);
  if (!reader.finished()) return malformed("§4.5.1", "the GOP's header has a wrong size");
  const std::size_t rows = std::size_t{plan->header.components} + 1;
  row_coder_.reset();
  if (!can_allocate(RowCoder::bytes(rows))) return out_of_memory();
  rows_.clear();
  if (!try_resize(rows_, 3 * rows) || !sums_.reserve(plan->planes.component_count())) return out_of_memory();
  plan_ = std::move(plan);
  row_coder_.emplace(plan_->scales);
  digest_ = Hasher();
  info_ = basis_gop_info(header, plan_->header);
  info_.flagged = 0;
  plan_->mesh->coded.for_each_drawn(
      [this](std::uint32_t t, std::uint32_t) { info_.flagged += plan_->flagged(t) ? 1 : 0; });
  return {};
}

// format-spec §7.8.4
Status BasisDecoder::take(Bytes packet, Predictor predictor) {
  if (predictor != Predictor::kRows) return malformed("§4.5.2", "a frame of a GOP in mode basis has no rows");
  const Result<Bytes> piece = positions_piece(channels_, packet);
  if (!piece) return piece.error();
  RangeDecoder coder(*piece);
  const bool inside = row_coder_->code_frame(coder, rows_);
  if (!inside && !coder.overrun()) return malformed("§7.8.4", "a row of a basis is out of range");
  if (!coder.finished()) return malformed("§6.1", "the frame's rows do not fill its packet exactly");
  digest_.update(std::span<const std::int32_t>(rows_));
  if (!sums_.take(plan_->planes, plan_->scales, rows_))
    return malformed("§7.8.5", "the rows of a basis are too large for its planes");
  return {};
}

Status BasisDecoder::take_measured(Bytes packet, Predictor predictor, std::array<double, 3>& bits) {
  const Result<Bytes> piece = positions_piece(channels_, packet);
  bits.fill(piece ? 8.0 * static_cast<double>(piece->size()) / 3 : 0);
  return take(packet, predictor);
}

// format-spec §7.6
Status BasisDecoder::check_digest(Bytes packet) const {
  return compare_digest(channels_, packet, digest_.value());
}

// format-spec §7.8.5
void BasisDecoder::copy_positions(void* positions, std::size_t stride) const {
  const BasisHeader& basis = plan_->header;
  constexpr double kLargest = std::numeric_limits<float>::max();
  const double scale = std::ldexp(basis.step, -basis.fraction_bits);
  auto* const target = static_cast<std::byte*>(positions);
  const std::span<const std::uint32_t> order = plan_->order();
  for_each_block(plan_->planes, sums_, [&](const auto& sums, std::size_t first, std::size_t count) {
    std::array<std::array<float, CoefficientPlanes::kAtOnce>, 3> axes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < CoefficientPlanes::kAtOnce; ++i) {
        const double position = basis.origin[axis] + sums[axis][i] * scale;
        axes[axis][i] = static_cast<float>(std::clamp(position, -kLargest, kLargest));
      }
    }
    // One at a time: a vector would have to wait for what was just written piece by piece.
    for (std::size_t i = 0; i < count; ++i) {
      std::byte* const vertex = target + stride * (order.empty() ? first + i : order[first + i]);
      for (std::size_t axis = 0; axis < 3; ++axis) std::memcpy(vertex + 4 * axis, &axes[axis][i], 4);
    }
  });
}

void BasisDecoder::copy_lattice(std::span<std::int32_t> indices) const {
  constexpr double kLargest = std::numeric_limits<std::int32_t>::max();
  const double scale = std::ldexp(1.0, -plan_->header.fraction_bits);
  const std::span<const std::uint32_t> order = plan_->order();
  for_each_block(plan_->planes, sums_, [&](const auto& sums, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = 3 * (order.empty() ? first + i : order[first + i]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double nearest = std::floor(sums[axis][i] * scale + 0.5);
        indices[at + axis] = static_cast<std::int32_t>(std::clamp(nearest, -kLargest, kLargest));
      }
    }
  });
}

void BasisDecoder::copy_flags(std::span<std::uint8_t> flags) const {
  plan_->mesh->coded.for_each_drawn(
      [&](std::uint32_t t, std::uint32_t v) { flags[v] = plan_->flagged(t) ? 1 : 0; });
}

BasisInfo BasisDecoder::basis() const {
  if (plan_ == nullptr) return {};
  const CoefficientPlanes& planes = plan_->planes;
  BasisInfo info{plan_->number, static_cast<std::uint32_t>(planes.component_count()), 0};
  for (std::size_t a = 0; a < planes.component_count(); ++a) info.most = std::max(info.most, planes.most(a));
  return info;
}

template <class Number>
void BasisDecoder::copy_planes(std::size_t group, std::span<Number> values) const {
  const CoefficientPlanes& planes = plan_->planes;
  const std::span<const std::uint32_t> order = plan_->order();
  const auto place = [&](std::size_t v) { return values.data() + 4 * (order.empty() ? v : order[v]); };
  const std::size_t pairs = std::min<std::size_t>(2, planes.pair_count() - 2 * group);
  for (std::size_t v = 0; v < planes.vertex_count(); ++v) {
    const auto* const block = planes.pairs(v / CoefficientPlanes::kAtOnce) + 2 * group;
    for (std::size_t pair = 0; pair < 2; ++pair) {
      const CoefficientPlanes::Pair both =
          pair < pairs ? block[pair][v % CoefficientPlanes::kAtOnce] : CoefficientPlanes::Pair{};
      place(v)[2 * pair] = both[0];
      place(v)[2 * pair + 1] = both[1];
    }
  }
  for (const CoefficientPlanes::Large& large : planes.large()) {
    if (large.component / 4 != group) continue;
    for (std::size_t v = 0; v < planes.vertex_count(); ++v)
      place(v)[large.component % 4] = static_cast<Number>(large.values[v]);
  }
}

template void BasisDecoder::copy_planes(std::size_t group, std::span<float> values) const;
template void BasisDecoder::copy_planes(std::size_t group, std::span<std::int16_t> values) const;

// format-spec §7.8.5
void BasisDecoder::copy_rows(std::span<float> rows) const {
  const BasisHeader& basis = plan_->header;
  constexpr double kLargest = std::numeric_limits<float>::max();
  const double scale = std::ldexp(basis.step, -basis.fraction_bits);
  for (std::size_t row = 0; row <= plan_->planes.component_count(); ++row) {
    const auto factor = static_cast<double>(basis.scale(row).factor());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = rows_[3 * row + axis] * factor * scale + (row == 0 ? basis.origin[axis] : 0);
      rows[3 * row + axis] = static_cast<float>(std::clamp(value, -kLargest, kLargest));
    }
  }
}

}  // namespace tvg
