#pragma once
#include <array>
#include <span>

#include <tvg/source.hpp>

namespace tvg::cli {

/// The axis that points up in a sequence (metadata `up`).
enum class UpAxis { kY, kZ };

/// kZ where the metadata say so.
UpAxis up_axis_of(const Metadata& metadata);

/// An axis-aligned box around what is shown.
class Bounds {
 public:
  /// Takes in positions, [vertex][xyz]. A vertex with a coordinate that is not finite does not count.
  void extend(std::span<const float> positions);
  /// Grows each side by `share` of the box's diagonal at both ends.
  void pad(double share);

  bool empty() const { return empty_; }
  /// Of an empty box: 0.
  const std::array<double, 3>& low() const { return low_; }
  const std::array<double, 3>& high() const { return high_; }
  std::array<double, 3> center() const;
  /// Half the diagonal; 1 where all that was taken in is one point or nothing, so that it can be divided by.
  double radius() const;

 private:
  bool empty_ = true;
  std::array<double, 3> low_{};
  std::array<double, 3> high_{};
};

}  // namespace tvg::cli
