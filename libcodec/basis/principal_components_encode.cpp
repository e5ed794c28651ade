#include "basis/principal_components_encode.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace tvg {

Trajectories trajectories_of(std::span<const FramePositions> frames, std::span<const std::uint32_t> order,
                             std::span<const float> weights, const std::array<double, 3>& origin,
                             double step) {
  const auto vertices = static_cast<Eigen::Index>(order.size());
  Trajectories result;
  result.weighted.resize(vertices, static_cast<Eigen::Index>(3 * frames.size()));
  result.weights = Eigen::Map<const Eigen::VectorXf>(weights.data(), vertices);
  const double total = result.mean_weight();
  for (std::size_t f = 0; f < frames.size(); ++f) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto column = static_cast<Eigen::Index>(3 * f + axis);
      double sum = 0;
      for (std::size_t v = 0; v < order.size(); ++v)
        sum += double{weights[v]} * weights[v] * (frames[f][3 * std::size_t{order[v]} + axis] - origin[axis]);
      const double mean = sum / total;
      for (std::size_t v = 0; v < order.size(); ++v) {
        const double offset = frames[f][3 * std::size_t{order[v]} + axis] - origin[axis] - mean;
        result.weighted(static_cast<Eigen::Index>(v), column) =
            static_cast<float>(weights[v] * offset / step);
      }
      result.mean.push_back(mean / step);
    }
  }
  return result;
}

namespace {

/// Of all columns with each other, in binary64: the small components are a millionth of the large ones.
Eigen::MatrixXd gram_of(const Eigen::MatrixXf& trajectories) {
  constexpr Eigen::Index kAtOnce = 256;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(trajectories.cols(), trajectories.cols());
  for (Eigen::Index first = 0; first < trajectories.rows(); first += kAtOnce) {
    const Eigen::Index count = std::min(kAtOnce, trajectories.rows() - first);
    const Eigen::MatrixXd block = trajectories.middleRows(first, count).cast<double>().transpose();
    gram.selfadjointView<Eigen::Lower>().rankUpdate(block);
  }
  return gram;
}

}  // namespace

PrincipalComponents principal_components(const Eigen::MatrixXf& trajectories, double rest) {
  PrincipalComponents result;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram_of(trajectories));
  const Eigen::VectorXd energies = solver.eigenvalues().reverse().cwiseMax(0);
  result.total = energies.sum();
  Eigen::Index count = 0;
  for (double left = result.total; count < energies.size() && left > rest; ++count) left -= energies(count);
  count = std::min(count, trajectories.rows());
  result.rows = solver.eigenvectors().rightCols(count).rowwise().reverse().cast<float>();
  result.coefficients.noalias() = trajectories * result.rows;
  result.energies.assign(energies.data(), energies.data() + count);
  return result;
}

}  // namespace tvg
