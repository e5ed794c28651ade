#include "basis/basis_sums.hpp"

#include "base/allocation.hpp"

#include <algorithm>
#include <bit>

namespace tvg {

namespace {

constexpr std::int64_t kMostSum = std::int64_t{1} << 52;

std::int64_t size_of(std::int64_t value) {
  return value < 0 ? -value : value;
}

}  // namespace

bool BasisSums::reserve(std::size_t components) {
  factors_.clear();
  low_.clear();
  return try_resize(factors_, components) && try_resize(high_, (components + 1) / 2) &&
         try_reserve(low_, (components + 1) / 2);
}

// format-spec §7.8.5
bool BasisSums::take(const CoefficientPlanes& planes, Bytes scales, std::span<const std::int32_t> rows) {
  std::int64_t largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::int64_t bound = 0;
    for (std::size_t row = 0; row <= factors_.size(); ++row) {
      const std::int64_t value = rows[3 * row + axis];
      const RowScale scale{scales[row]};
      const std::int64_t most = row == 0 ? 1 : planes.most(row - 1);
      // At most 2^24 * 2^30 * 7: it is the scale's power of two that could be too much.
      const std::int64_t term = most * size_of(value) * (4 + (scale.code & 3));
      if (term >= kMostSum >> (scale.code >> 2)) return false;
      bound += term << (scale.code >> 2);
      if (bound >= kMostSum) return false;
      const std::int64_t factor = most == 0 ? 0 : value * scale.factor();
      (row == 0 ? mean_ : factors_[row - 1])[axis] = factor;
      if (row > 0 && most <= 0x7FFF) largest = std::max(largest, size_of(factor));
    }
  }
  low_bits_ = std::max(static_cast<int>(std::bit_width(static_cast<std::uint64_t>(largest))) - 14, 0);
  within_32_bits_ = low_bits_ <= 15;
  if (within_32_bits_) split(planes);
  return true;
}

/// Cuts the factors in two parts of 16 bits, and sees whether sums stay within 32 bits.
void BasisSums::split(const CoefficientPlanes& planes) {
  constexpr std::int64_t kMost = 0x7FFFFFFF;
  std::array<std::int64_t, 3> high_bound{}, low_bound{};
  low_.clear();
  for (std::size_t pair = 0; pair < high_.size(); ++pair) {
    RowPair high{}, low{};
    bool any_low = false;
    for (std::size_t side = 0; side < 2 && 2 * pair + side < factors_.size(); ++side) {
      const std::size_t a = 2 * pair + side;
      if (planes.most(a) > 0x7FFF) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t factor = factors_[a][axis];
        const std::int64_t upper = (factor + ((std::int64_t{1} << low_bits_) >> 1)) >> low_bits_;
        const std::int64_t lower = factor - upper * (std::int64_t{1} << low_bits_);
        high[axis][side] = static_cast<std::int16_t>(upper);
        low[axis][side] = static_cast<std::int16_t>(lower);
        any_low = any_low || lower != 0;
        high_bound[axis] += planes.most(a) * size_of(upper);
        low_bound[axis] += planes.most(a) * size_of(lower);
      }
    }
    high_[pair] = high;
    if (any_low) low_.push_back({static_cast<std::uint32_t>(pair), low});
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    within_32_bits_ = within_32_bits_ && high_bound[axis] <= kMost && low_bound[axis] <= kMost;
}

void BasisSums::sum(const CoefficientPlanes& planes, std::size_t block, SumBlock& sums) const {
  const CoefficientPlanes::PairBlock* const pairs = planes.pairs(block);
  if (within_32_bits_) {
    sum_pairs(pairs, sums);
  } else {
    sum_plainly(planes, pairs, sums);
  }
  for (const CoefficientPlanes::Large& large : planes.large()) {
    const std::int32_t* const values = large.values.data() + block * CoefficientPlanes::kAtOnce;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto factor = static_cast<double>(factors_[large.component][axis]);
      for (std::size_t i = 0; i < CoefficientPlanes::kAtOnce; ++i) sums[axis][i] += values[i] * factor;
    }
  }
}

/// The sums whatever the sizes are.
void BasisSums::sum_plainly(const CoefficientPlanes& planes, const CoefficientPlanes::PairBlock* pairs,
                            SumBlock& sums) const {
  for (std::size_t axis = 0; axis < 3; ++axis) sums[axis].fill(static_cast<double>(mean_[axis]));
  for (std::size_t a = 0; a < factors_.size(); ++a) {
    if (planes.most(a) > 0x7FFF) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto factor = static_cast<double>(factors_[a][axis]);
      for (std::size_t i = 0; i < CoefficientPlanes::kAtOnce; ++i)
        sums[axis][i] += pairs[a / 2][i][a % 2] * factor;
    }
  }
}

void BasisSums::sum_pairs(const CoefficientPlanes::PairBlock* pairs, SumBlock& sums) const {
  PairSums upper, lower;
  add_pairs(pairs, high_, low_, upper, lower);
  const auto unit = static_cast<double>(std::int64_t{1} << low_bits_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto mean = static_cast<double>(mean_[axis]);
    for (std::size_t i = 0; i < CoefficientPlanes::kAtOnce; ++i)
      sums[axis][i] = mean + upper[axis][i] * unit + lower[axis][i];
  }
}

}  // namespace tvg
