#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// The trajectories of a run of frames, and the basis of all trajectories that leaves least when it is cut.
struct Trajectories {
  /// [vertex][3 frame + axis]: positions less `mean`, each vertex times its weight, in steps of a lattice.
  Eigen::MatrixXf weighted;
  std::vector<double> mean;  ///< [3 frame + axis], less the origin, in steps
  Eigen::VectorXf weights;   ///< [vertex]

  /// How much a squared error of the mean counts.
  double mean_weight() const { return weights.cast<double>().squaredNorm(); }
};

/// Positions [frame][vertex][xyz] as trajectories, in the order of `order` ([index] vertex); `weights` are
/// [index]. The mean is the one that leaves least.
Trajectories trajectories_of(std::span<const FramePositions> frames, std::span<const std::uint32_t> order,
                             std::span<const float> weights, const std::array<double, 3>& origin,
                             double step);

/// Components by falling energy.
struct PrincipalComponents {
  Eigen::MatrixXf rows;          ///< [3 frame + axis][component], orthonormal
  Eigen::MatrixXf coefficients;  ///< [vertex][component]
  std::vector<double> energies;  ///< [component] sum of squared coefficients
  double total = 0;              ///< of all there are
};

/// The components that leave no more than `rest` of the sum of squares.
PrincipalComponents principal_components(const Eigen::MatrixXf& trajectories, double rest);

}  // namespace tvg
