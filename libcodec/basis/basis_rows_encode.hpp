#pragma once
#include "basis/basis_fit_encode.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace tvg {

/// What rows take, as far as can be told before they are coded.
class RowCosts {
 public:
  /// `rows` are [3 frame + axis][component].
  explicit RowCosts(const Eigen::MatrixXf& rows);

  /// Bits of a component's row whose values are multiples of `unit`.
  double bits(std::size_t component, double unit) const;

 private:
  double values_;                  ///< of a row
  std::vector<double> surprises_;  ///< [component] how much a value differs from what those before tell
};

/// The unit of a row that costs as much as coefficients do: with more energy its errors weigh more.
double row_unit(const CoefficientQuality& quality, double energy);

/// What the rows of a basis take when they are coded, as one GOP.
std::size_t row_bytes(const FittedBasis& fitted);

/// Gives a fitted basis its rows: those which fit its coefficients as they were quantized, in the sense of
/// least squares, for what was rounded to zero took something from all components. Tells `squared_error` but
/// for what is rounded off the mean.
void fit_rows(const Trajectories& trajectories, const Coefficients& coefficients, const Eigen::MatrixXf& rows,
              const CoefficientQuality& quality, FittedBasis& fitted);

/// Measures what a basis misses that has its rows: `squared_error`, and a bound of `largest_error` that is
/// above it by rounding alone.
void measure_errors(const Trajectories& trajectories, const Coefficients& coefficients, FittedBasis& fitted);

}  // namespace tvg
