#include "basis/basis_rows_encode.hpp"

#include "basis/row_coder.hpp"
#include "entropy/range_coder.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace tvg {

RowCosts::RowCosts(const Eigen::MatrixXf& rows) : values_(static_cast<double>(rows.rows())) {
  for (Eigen::Index a = 0; a < rows.cols(); ++a) {
    // What is left of values when none, one, two or three of those before are taken into account.
    std::array<double, 4> left{};
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      double last = 0, last2 = 0, last3 = 0;
      for (Eigen::Index i = axis; i < rows.rows(); i += 3) {
        const double value = rows(i, a);
        left[0] += std::abs(value);
        left[1] += std::abs(value - last);
        left[2] += std::abs(value - 2 * last + last2);
        left[3] += std::abs(value - 3 * last + 3 * last2 - last3);
        last3 = last2;
        last2 = last;
        last = value;
      }
    }
    surprises_.push_back(*std::min_element(left.begin(), left.end()) / values_);
  }
}

double RowCosts::bits(std::size_t component, double unit) const {
  return values_ * std::log2(1 + 4 * surprises_[component] / unit);
}

double row_unit(const CoefficientQuality& quality, double energy) {
  return std::sqrt(quality.thrift) * quality.step / std::sqrt(std::max(energy, quality.step * quality.step));
}

namespace {

/// The scale whose factor is nearest to this one, which is at least 4.
RowScale scale_near(double factor) {
  const int exponent = std::max(std::ilogb(factor) - 2, 0);
  const auto quarters = static_cast<int>(std::lround(std::ldexp(factor, -exponent)));
  const int code = 4 * exponent + std::clamp(quarters - 4, 0, 4);
  return {static_cast<std::uint8_t>(std::min<int>(code, RowScale::kMost))};
}

/// [vertex][component], in steps of the trajectories.
Eigen::MatrixXf quantized(const Coefficients& coefficients, const FittedBasis& fitted) {
  Eigen::MatrixXf values(coefficients.values.rows(),
                         static_cast<Eigen::Index>(fitted.coefficients.components));
  for (Eigen::Index a = 0; a < values.cols(); ++a) {
    const auto plane = static_cast<std::size_t>(a);
    const std::vector<Quad>& group = fitted.coefficients.values[plane / CoefficientCoder::kPlanes];
    for (std::size_t v = 0; v < group.size(); ++v) {
      const std::int32_t index = group[v][plane % CoefficientCoder::kPlanes] >> coefficients.shift_of(v);
      values(static_cast<Eigen::Index>(v), a) = static_cast<float>(fitted.step * index);
    }
  }
  return values;
}

/// Rounds the mean and the rows, [component][3 frame + axis], to multiples of their units.
class RowRounding {
 public:
  RowRounding(const Trajectories& trajectories, Eigen::MatrixXf& rows, FittedBasis& fitted)
      : trajectories_(trajectories), rows_(rows), fitted_(fitted), most_(most_of(fitted)) {}

  /// `units` are [row], in steps of the basis; they are made larger where values or sums would leave their
  /// bounds.
  void run(std::vector<double> units) {
    for (std::size_t row = 0; row < units.size(); ++row) widen(units[row], row);
    while (!round_all(units)) {
      const double least = *std::min_element(units.begin(), units.end());
      for (double& unit : units) unit = std::max(unit, 2 * least);
    }
  }

  /// What rounding took from the mean, [3 frame + axis], in steps of the trajectories.
  Eigen::Map<const Eigen::VectorXd> missed_means() const {
    return {missed_means_.data(), static_cast<Eigen::Index>(missed_means_.size())};
  }

 private:
  /// [row] the largest factor of the row's values: 1 for the mean.
  static std::vector<double> most_of(const FittedBasis& fitted) {
    std::vector<double> most(fitted.coefficients.components + 1, 1.0);
    for (std::size_t a = 0; a + 1 < most.size(); ++a) {
      for (const Quad& quad : fitted.coefficients.values[a / CoefficientCoder::kPlanes])
        most[a + 1] =
            std::max(most[a + 1], std::abs(static_cast<double>(quad[a % CoefficientCoder::kPlanes])));
    }
    return most;
  }

  double value(std::size_t row, std::size_t i) const {
    return row == 0 ? trajectories_.mean[i] / fitted_.step
                    : double{rows_(static_cast<Eigen::Index>(row - 1), static_cast<Eigen::Index>(i))};
  }

  /// No value may be beyond what the coder of rows takes.
  void widen(double& unit, std::size_t row) const {
    for (std::size_t i = 0; i < trajectories_.mean.size(); ++i)
      unit = std::max(unit, std::abs(value(row, i)) / (0.5 * RowCoder::kMostValue));
  }

  /// False where a sum could be too large for its fraction bits.
  // format-spec §7.8.5
  bool round_all(const std::vector<double>& units) {
    const double least = *std::min_element(units.begin(), units.end());
    fitted_.fraction_bits = std::clamp(2 - std::ilogb(least), 0, BasisHeader::kMostFractionBits);
    fitted_.scales.clear();
    std::vector<double> bounds(trajectories_.mean.size());
    for (std::size_t row = 0; row < units.size(); ++row) {
      const RowScale scale = scale_near(std::ldexp(units[row], fitted_.fraction_bits));
      fitted_.scales.push_back(scale.code);
      for (std::size_t i = 0; i < bounds.size(); ++i)
        bounds[i] +=
            most_[row] * (std::abs(value(row, i) / unit_of(scale)) + 1) * static_cast<double>(scale.factor());
    }
    if (*std::max_element(bounds.begin(), bounds.end()) >= 0x1p51) return false;
    fitted_.rows.resize(units.size() * trajectories_.mean.size());
    for (std::size_t row = 0; row < units.size(); ++row) round(row, unit_of({fitted_.scales[row]}));
    return true;
  }

  double unit_of(RowScale scale) const {
    return std::ldexp(static_cast<double>(scale.factor()), -fitted_.fraction_bits);
  }

  void round(std::size_t row, double unit) {
    const std::size_t rows = fitted_.scales.size();
    for (std::size_t i = 0; i < trajectories_.mean.size(); ++i) {
      const double wanted = value(row, i), multiple = std::nearbyint(wanted / unit);
      fitted_.rows[3 * (i / 3 * rows + row) + i % 3] = static_cast<std::int32_t>(multiple);
      if (row > 0) {
        rows_(static_cast<Eigen::Index>(row - 1), static_cast<Eigen::Index>(i)) =
            static_cast<float>(multiple * unit);
      } else {
        missed_means_.push_back((wanted - multiple * unit) * fitted_.step);
      }
    }
  }

  const Trajectories& trajectories_;
  Eigen::MatrixXf& rows_;
  FittedBasis& fitted_;
  std::vector<double> most_;
  std::vector<double> missed_means_;
};

}  // namespace

std::size_t row_bytes(const FittedBasis& fitted) {
  const std::size_t values = 3 * fitted.scales.size();
  RowCoder coder(fitted.scales);
  RangeEncoder encoder;
  std::size_t bytes = 0;
  std::vector<std::int32_t> frame(values);
  for (std::size_t at = 0; at < fitted.rows.size(); at += values) {
    std::copy_n(fitted.rows.begin() + static_cast<std::ptrdiff_t>(at), values, frame.begin());
    coder.code_frame(encoder, frame);
    bytes += encoder.finish().size();
  }
  return bytes;
}

namespace {

/// What rows that are off by this much add to a rest's squares: `gram` is of the planes with each other,
/// `pull` theirs with the rest. Much less work than the rest itself.
double squares_added(const Eigen::MatrixXd& gram, const Eigen::MatrixXf& pull, const Eigen::MatrixXd& off) {
  return off.cwiseProduct(gram * off).sum() - 2 * off.cwiseProduct(pull.cast<double>()).sum();
}

}  // namespace

void fit_rows(const Trajectories& trajectories, const Coefficients& coefficients, const Eigen::MatrixXf& rows,
              const CoefficientQuality& quality, FittedBasis& fitted) {
  std::vector<double> units = {std::sqrt(quality.thrift / trajectories.mean_weight())};
  Eigen::MatrixXf fitting;
  if (fitted.coefficients.components == 0) {
    RowRounding(trajectories, fitting, fitted).run(std::move(units));
    measure_errors(trajectories, coefficients, fitted);
    return;
  }
  const Eigen::MatrixXf planes = quantized(coefficients, fitted);
  const Eigen::MatrixXf unfitted = rows.leftCols(planes.cols()).transpose();
  Eigen::MatrixXf rest = trajectories.weighted;
  rest.noalias() -= planes * unfitted;
  const Eigen::MatrixXf pull = planes.transpose() * rest;
  Eigen::MatrixXf half_gram = Eigen::MatrixXf::Zero(planes.cols(), planes.cols());
  half_gram.selfadjointView<Eigen::Lower>().rankUpdate(planes.transpose());
  const Eigen::MatrixXd gram = half_gram.cast<double>().selfadjointView<Eigen::Lower>();
  Eigen::MatrixXd damped = gram;
  damped.diagonal().array() += fitted.step * fitted.step;  // a plane of zeros has no say
  fitting = unfitted + damped.ldlt().solve(pull.cast<double>()).cast<float>();
  for (Eigen::Index a = 0; a < planes.cols(); ++a) units.push_back(row_unit(quality, damped(a, a)));
  RowRounding rounding(trajectories, fitting, fitted);
  rounding.run(std::move(units));
  const Eigen::MatrixXd off = fitting.cast<double>() - unfitted.cast<double>();
  const Eigen::VectorXf rest_by_weight = rest.transpose() * trajectories.weights,
                        planes_by_weight = planes.transpose() * trajectories.weights;
  const Eigen::VectorXd tilt =
      rest_by_weight.cast<double>() - off.transpose() * planes_by_weight.cast<double>();
  const auto missed = rounding.missed_means();
  fitted.squared_error = rest.cast<double>().squaredNorm() + squares_added(gram, pull, off) +
                         2 * missed.dot(tilt) + trajectories.mean_weight() * missed.squaredNorm();
}

void measure_errors(const Trajectories& trajectories, const Coefficients& coefficients, FittedBasis& fitted) {
  constexpr Eigen::Index kColumnsAtOnce = 64;
  const Eigen::MatrixXd planes = quantized(coefficients, fitted).cast<double>();
  const Eigen::VectorXd weights = trajectories.weights.cast<double>();
  const std::size_t row_count = fitted.scales.size();
  const auto value = [&](std::size_t row, std::size_t i) {
    const double unit =
        std::ldexp(static_cast<double>(RowScale{fitted.scales[row]}.factor()), -fitted.fraction_bits);
    return unit * fitted.rows[3 * (i / 3 * row_count + row) + i % 3];
  };
  fitted.squared_error = 0;
  fitted.largest_error = 0;
  const Eigen::Index columns = trajectories.weighted.cols();
  for (Eigen::Index first = 0; first < columns; first += kColumnsAtOnce) {
    const Eigen::Index count = std::min(kColumnsAtOnce, columns - first);
    Eigen::MatrixXd fitting(planes.cols(), count);
    Eigen::RowVectorXd missed_means(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto column = static_cast<std::size_t>(first + i);
      missed_means(i) = trajectories.mean[column] - fitted.step * value(0, column);
      for (Eigen::Index a = 0; a < fitting.rows(); ++a)
        fitting(a, i) = value(static_cast<std::size_t>(a) + 1, column);
    }
    Eigen::MatrixXd rest = trajectories.weighted.middleCols(first, count).cast<double>();
    if (planes.cols() > 0) rest.noalias() -= planes * fitting;
    rest.noalias() += weights * missed_means;
    fitted.squared_error += rest.squaredNorm();
    fitted.largest_error = std::max(fitted.largest_error, rest.cwiseAbs().maxCoeff());
  }
  // Trajectories and planes are float32: what they were rounded by counts, since the decoder's sums are
  // exact.
  constexpr double kRounding = 0x1p-22;
  fitted.largest_error += kRounding * double{trajectories.weighted.cwiseAbs().maxCoeff()};
}

}  // namespace tvg
