#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace tvg::cli {

/// What a track has between two keys.
enum class Interpolation {
  kStep,    ///< the value of the first, until the second
  kLinear,  ///< a straight way, of rotations the shortest arc
  kCubic    ///< a Hermite spline, of rotations made unit length afterwards
};

/// What a channel does before its first key and after its last.
enum class Extrapolation { kHold, kLinear, kRepeat };

/// Values over time.
struct Track {
  std::size_t width = 0;     ///< numbers of a value
  bool is_rotation = false;  ///< values are unit quaternions (x, y, z, w), but for those of splines
  Interpolation interpolation = Interpolation::kLinear;
  std::vector<double> times = {};  ///< [key], in seconds
  /// [key][width]; of splines [key][in-tangent, value, out-tangent][width], tangents per second.
  std::vector<double> values = {};

  bool empty() const { return times.empty(); }
  /// Numbers that belong to a key.
  std::size_t key_size() const { return interpolation == Interpolation::kCubic ? 3 * width : width; }
  /// The value of a key, `width` numbers.
  std::span<const double> value(std::size_t key) const;
  /// The value at a time in seconds into `out`, `width` numbers. There is a key, and times never decrease.
  void at(double seconds, bool linear_before, bool linear_after, std::span<double> out) const;
  /// Puts keys in order of time, which few formats promise.
  void sort_by_time();
};

}  // namespace tvg::cli
