#include "basis/coefficient_choice_encode.hpp"

#include "entropy/range_coder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tvg {

namespace {

constexpr std::uint32_t kWhole = 1u << 16;

/// [share of 2^16] bits that it takes.
const std::vector<float>& bits_of_shares() {
  static const std::vector<float> bits = [] {
    std::vector<float> table(kWhole + 1, 0.0f);
    for (std::size_t share = 1; share < table.size(); ++share)
      table[share] = static_cast<float>(16 - std::log2(static_cast<double>(share)));
    return table;
  }();
  return bits;
}

/// Chooses residuals of a group of planes.
class ResidualChooser {
 public:
  ResidualChooser(const Coefficients& coefficients, const CoefficientQuality& quality, std::size_t first)
      : coefficients_(coefficients),
        inverse_step_(static_cast<float>(1 / quality.step)),
        price_(static_cast<float>(quality.thrift * std::log(2.0) / 6)),
        first_(first),
        bits_(bits_of_shares().data()) {}

  Quad operator()(const MagnitudeModels& models, const AdaptiveBit& stirs,
                  const CoefficientForecast& forecast) const {
    std::array<float, CoefficientCoder::kPlanes> wanted{};
    bool all_round_to_zero = true;
    for (std::size_t j = 0; j < forecast.count; ++j) {
      wanted[j] = coefficients_.values(static_cast<Eigen::Index>(forecast.vertex),
                                       static_cast<Eigen::Index>(first_ + j)) *
                      inverse_step_ -
                  static_cast<float>(forecast.rounded[j]);
      all_round_to_zero = all_round_to_zero && std::lrint(wanted[j]) == 0;
    }
    if (all_round_to_zero) return {};
    Quad best{};
    float cost_of_none = 0, cost_of_best = 0;
    for (std::size_t j = 0; j < forecast.count; ++j) {
      cost_of_none += wanted[j] * wanted[j];
      const auto [residual, cost] = cheapest(models, forecast.expected(j), wanted[j]);
      best[j] = residual;
      cost_of_best += cost;
    }
    if (best == Quad{}) return best;
    cost_of_none += price_ * bits_[2 * stirs.zero_frequency()];
    cost_of_best += price_ * bits_[kWhole - 2 * stirs.zero_frequency()];
    return cost_of_none <= cost_of_best ? Quad{} : best;
  }

 private:
  struct Choice {
    std::int32_t residual;
    float cost;
  };

  Choice cheapest(const MagnitudeModels& models, const Expectation& expected, float wanted) const {
    const auto nearest = static_cast<std::int32_t>(std::lrint(wanted));
    Choice best{nearest, cost(models, expected, wanted, nearest)};
    if (nearest == 0) return best;
    const std::int32_t nearer = nearest > 0 ? nearest - 1 : nearest + 1;
    const auto consider = [&](std::int32_t residual) {
      const float cost_here = cost(models, expected, wanted, residual);
      if (cost_here < best.cost) best = {residual, cost_here};
    };
    consider(nearer);
    if (nearer != 0 && std::abs(nearest) <= 3) consider(0);
    return best;
  }

  float cost(const MagnitudeModels& models, const Expectation& expected, float wanted,
             std::int32_t residual) const {
    const MagnitudeModels::Likelihood likelihood = models.likelihood(expected, residual);
    const float missed = wanted - static_cast<float>(residual);
    return missed * missed + price_ * (static_cast<float>(likelihood.raw_bits) + bits_[likelihood.share]);
  }

  const Coefficients& coefficients_;
  float inverse_step_, price_;
  std::size_t first_;
  const float* bits_;
};

/// Of the group's planes, in squared steps; `values` are on the fine lattice.
double error_of(const Coefficients& coefficients, const CoefficientQuality& quality, std::size_t first,
                std::size_t count, std::span<const Quad> values) {
  double error = 0;
  for (std::size_t v = 0; v < values.size(); ++v) {
    const int shift = coefficients.shift_of(v);
    for (std::size_t j = 0; j < count; ++j) {
      const double missed =
          coefficients.values(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(first + j)) /
              quality.step -
          (values[v][j] >> shift);
      error += missed * missed;
    }
  }
  return error;
}

}  // namespace

CodedCoefficients code_coefficients(const Coefficients& coefficients, const CoefficientQuality& quality,
                                    const std::function<double(std::size_t)>& row_bits) {
  const double squared_step = quality.step * quality.step;
  const double price = quality.thrift * std::log(2.0) / 6 * squared_step;
  CodedCoefficients result;
  result.error = coefficients.total;
  CoefficientCoder coder(coefficients.pyramid, coefficients.flags, coefficients.nested_bits,
                         coefficients.part_ends);
  RangeEncoder encoder;
  std::vector<Quad> values(static_cast<std::size_t>(coefficients.values.rows()));
  while (result.components < coefficients.energies.size()) {
    const std::size_t first = result.components;
    const std::size_t count = std::min(CoefficientCoder::kPlanes, coefficients.energies.size() - first);
    coder.begin_group(count);
    std::vector<std::vector<std::uint8_t>> group;
    std::size_t bytes = 0;
    for (std::size_t part = 0; part < coefficients.part_ends.size(); ++part) {
      coder.code_part(part, encoder, values, ResidualChooser(coefficients, quality, first));
      group.push_back(encoder.finish());
      bytes += group.back().size() + 2;
    }
    coder.end_group();
    double gain = -squared_step * error_of(coefficients, quality, first, count, values);
    double bits = 8.0 * static_cast<double>(bytes);
    for (std::size_t a = first; a < first + count; ++a) {
      gain += coefficients.energies[a];
      bits += row_bits(a);
    }
    if (first > 0 && gain < price * bits) break;
    result.components += count;
    result.error -= gain;
    result.bytes += bytes;
    result.groups.push_back(std::move(group));
    result.values.push_back(values);
  }
  return result;
}

}  // namespace tvg
