#pragma once
#include <array>
#include <cstddef>

// Small least squares that learn as they go (format-spec §7.8.4). All in binary64, each operation rounded by
// itself and in the order written.
namespace tvg {

/// Values times the N numbers they are told by, and these times each other, summed over many values of which
/// older ones count less.
template <std::size_t N>
class LeastSquares {
 public:
  using Numbers = std::array<double, N>;

  void fade(double factor) {
    for (double& product : products_) product *= factor;
    for (double& target : targets_) target *= factor;
  }

  void add(const LeastSquares& other) {
    for (std::size_t i = 0; i < products_.size(); ++i) products_[i] += other.products_[i];
    for (std::size_t i = 0; i < N; ++i) targets_[i] += other.targets_[i];
  }

  void take(const Numbers& from, double target, double weight) {
    std::size_t at = 0;
    for (std::size_t i = 0; i < N; ++i) {
      const double weighted = weight * from[i];
      targets_[i] += weighted * target;
      for (std::size_t j = 0; j <= i; ++j) products_[at++] += weighted * from[j];
    }
  }

  /// The factors that tell best, drawn towards `expected`. What is made is what all numbers of factors up to
  /// `count` have in common; `factors` gives those of so many, the others being zero.
  class Solution {
   public:
    Solution(const LeastSquares& sums, double ridge, const Numbers& expected, std::size_t count) {
      std::size_t at = 0;
      for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j <= i; ++j) lower_[i][j] = sums.products_[at++];
        const double drawn = ridge + kRelativeRidge * lower_[i][i];
        lower_[i][i] += drawn;
        right_[i] = sums.targets_[i] + drawn * expected[i];
      }
      for (std::size_t k = 0; k < count; ++k) {
        // What was added to the diagonal keeps it positive.
        inverse_[k] = 1.0 / lower_[k][k];
        for (std::size_t i = k + 1; i < count; ++i) {
          const double factor = lower_[i][k] * inverse_[k];
          for (std::size_t j = k + 1; j <= i; ++j) lower_[i][j] -= factor * lower_[j][k];
          right_[i] -= factor * right_[k];
        }
      }
    }

    Numbers factors(std::size_t count) const {
      Numbers x{};
      for (std::size_t i = count; i-- > 0;) {
        double rest = right_[i];
        for (std::size_t j = i + 1; j < count; ++j) rest -= lower_[j][i] * x[j];
        x[i] = rest * inverse_[i];
      }
      return x;
    }

   private:
    /// Of each diagonal element, so that the solution is stable however alike the numbers are.
    static constexpr double kRelativeRidge = 0x1p-13;

    std::array<Numbers, N> lower_;
    Numbers right_, inverse_;
  };

 private:
  std::array<double, N*(N + 1) / 2> products_{};  ///< the lower triangle, row by row
  Numbers targets_{};
};

}  // namespace tvg
