#include "basis/basis_fit_encode.hpp"

#include "basis/basis_rows_encode.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace tvg {

namespace {

/// Looks for the largest step at which the target is hit: what is missed grows with the step, but for chance.
class StepSearch {
 public:
  explicit StepSearch(double first) : step_(std::log(first)) {}

  double step() const { return std::exp(step_); }

  /// Takes what the step led to: its error without fitted rows, and with them as a share of the target's, if
  /// that was measured. Goes on to another step.
  void take(double rough_error, std::optional<double> share) {
    if (share) shares_per_error_ = *share / std::max(rough_error, kLeast);
    trials_.push_back({step_, rough_error, share});
    const Trial *fine = nullptr, *coarse = nullptr;
    for (const Trial& trial : trials_) {
      const bool hits = missed_by(trial) <= 0;
      if (hits && (fine == nullptr || trial.step > fine->step)) fine = &trial;
      if (!hits && (coarse == nullptr || trial.step < coarse->step)) coarse = &trial;
    }
    if (fine != nullptr && coarse != nullptr && fine->step < coarse->step) {
      const double low = missed_by(*fine), high = missed_by(*coarse);
      const double part = std::clamp((kAim - low) / std::max(high - low, 1e-9), 0.1, 0.9);
      step_ = fine->step + part * (coarse->step - fine->step);
    } else {
      step_ += std::clamp(kSlope * (kAim - missed_by(trials_.back())), -2.0, 2.0);
    }
  }

  /// Whether a step may do that has this error without fitted rows.
  bool promises(double rough_error) const {
    const double share = rough_error * shares_per_error_;
    return shares_per_error_ == 0 || (share > 0.95 && share < 1.02);
  }
  static bool close(double share) { return share <= 1 && share > 0.982; }

 private:
  static constexpr double kAim = -0.004;  ///< logarithm of the share to aim at
  static constexpr double kSlope = 0.53;  ///< of logarithms: the step by the squared error
  static constexpr double kLeast = 1e-30;

  struct Trial {
    double step, rough_error;
    std::optional<double> share;
  };

  /// The logarithm of the share. Fitted rows make errors smaller by much the same share whatever the step.
  double missed_by(const Trial& trial) const {
    return std::log(std::max(trial.share.value_or(trial.rough_error * shares_per_error_), kLeast));
  }

  double step_;  ///< its logarithm
  double shares_per_error_ = 0;
  std::vector<Trial> trials_;
};

class Fitter {
 public:
  Fitter(const Trajectories& trajectories, const Pyramid& pyramid, std::span<const std::size_t> part_ends,
         std::span<const std::uint8_t> flags, int nested_bits, const FitTarget& target)
      : trajectories_(trajectories),
        target_(target),
        components_(principal_components(trajectories.weighted, may_be_left_out(target))),
        coefficients_{
            pyramid,           flags,    nested_bits, components_.coefficients, components_.energies,
            components_.total, part_ends},
        row_costs_(components_.rows) {}

  FittedBasis run(const FitEffort& effort) {
    FittedBasis best;
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (const double thrift : effort.thrifts) {
      FittedBasis fitted = fit(thrift, effort.tries);
      if (effort.thrifts.size() == 1) return fitted;
      const std::size_t bytes = fitted.coefficients.bytes + row_bytes(fitted);
      if (bytes >= least) continue;
      least = bytes;
      best = std::move(fitted);
    }
    return best;
  }

 private:
  static constexpr int kMostTries = 40;
  static constexpr double kWasteful = 0.98;  ///< share of the target below which more tries pay

  /// Energy of components that make next to no difference to the target.
  static double may_be_left_out(const FitTarget& target) {
    if (!target.largest_error) return target.squared_error / 50;
    return std::min(target.squared_error, *target.largest_error * *target.largest_error) / 50;
  }

  FittedBasis fit(double thrift, int tries) const {
    const auto values = static_cast<double>(trajectories_.weighted.size());
    StepSearch search(std::sqrt(4 * target_.squared_error / values));
    FittedBasis best;
    double best_share = std::numeric_limits<double>::max();
    const auto goes_on = [&](int i) {
      return i < tries || (best_share > 1 && i < kMostTries) || (best_share < kWasteful && i < 2 * tries);
    };
    for (int i = 0; goes_on(i); ++i) {
      const CoefficientQuality quality{search.step(), thrift};
      FittedBasis fitted = coded_with(quality);
      const double rough_error = fitted.coefficients.error;
      if (!target_.largest_error && i + 1 < tries && !search.promises(rough_error)) {
        search.take(rough_error, {});
        continue;
      }
      fit_rows(trajectories_, coefficients_, components_.rows, quality, fitted);
      if (target_.largest_error) measure_errors(trajectories_, coefficients_, fitted);
      const double share = share_of_target(fitted);
      search.take(rough_error, share);
      if (share <= 1 ? best_share > 1 || fitted.step > best.step : share < best_share) {
        best_share = share;
        best = std::move(fitted);
      }
      if (StepSearch::close(share)) break;
    }
    measure_errors(trajectories_, coefficients_, best);
    return best;
  }

  FittedBasis coded_with(const CoefficientQuality& quality) const {
    FittedBasis fitted;
    fitted.step = quality.step;
    fitted.coefficients = code_coefficients(coefficients_, quality, [&](std::size_t a) {
      return row_costs_.bits(a, row_unit(quality, components_.energies[a]));
    });
    return fitted;
  }

  double share_of_target(const FittedBasis& fitted) const {
    if (!target_.largest_error) return fitted.squared_error / target_.squared_error;
    const double share = fitted.largest_error / *target_.largest_error;
    return share * share;
  }

  const Trajectories& trajectories_;
  const FitTarget& target_;
  PrincipalComponents components_;
  Coefficients coefficients_;
  RowCosts row_costs_;
};

}  // namespace

FittedBasis fit_basis(const Trajectories& trajectories, const Pyramid& pyramid,
                      std::span<const std::size_t> part_ends, std::span<const std::uint8_t> flags,
                      int nested_bits, const FitTarget& target, const FitEffort& effort) {
  return Fitter(trajectories, pyramid, part_ends, flags, nested_bits, target).run(effort);
}

}  // namespace tvg
