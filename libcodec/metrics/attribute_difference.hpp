#pragma once
#include <cstdint>
#include <span>

#include <tvg/property_metrics.hpp>

namespace tvg {

/// Adds up how far the values of one attribute are off.
class DifferenceSum {
 public:
  explicit DifferenceSum(AttributeKind kind) : kind_(kind) {}

  /// A value of both sides, of any number of components.
  void add(std::span<const float> original, std::span<const float> decoded);
  /// Writes the figures.
  void give(AttributeDifference& difference) const;

 private:
  void add_difference(double difference);

  AttributeKind kind_;
  std::uint64_t values_ = 0, numbers_ = 0;
  double max_ = 0, sum_ = 0, squares_ = 0;
};

}  // namespace tvg
