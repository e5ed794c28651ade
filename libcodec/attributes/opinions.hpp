#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

// Several predictions of one value, of which those count most that were right nearby (format-spec §5.7.5).
namespace tvg {

/// Opinions and how far each was off where the value is known.
template <std::size_t kMost, std::size_t kWidth>
struct Opinions {
  std::array<std::array<double, kWidth>, kMost> opinion{};
  std::array<double, kMost> missed{};  ///< by how much the values beside were missed, summed
  std::array<double, kMost> credit{};
  int near = 0;  ///< how many there are beside

  /// The mean of the first `count`, by their credit; `usual` is by how much each misses usually.
  std::array<double, kWidth> mixed(std::span<const double> usual, double least, std::size_t count) {
    double total = 0;
    std::array<double, kWidth> sum{};
    for (std::size_t k = 0; k < count; ++k) {
      const double error = (missed[k] + usual[k]) / (near + 1) + least;
      const double inverse = 1 / (error * error);
      credit[k] = inverse * inverse;
      total = total + credit[k];
      for (std::size_t c = 0; c < kWidth; ++c) sum[c] = sum[c] + credit[k] * opinion[k][c];
    }
    for (double& x : sum) x = x / total;
    for (std::size_t k = 0; k < count; ++k) credit[k] = credit[k] / total;
    return sum;
  }
};

}  // namespace tvg
