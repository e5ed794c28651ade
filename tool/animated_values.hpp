#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include <tvg/decoder.hpp>

namespace tvg::cli {

/// The values of animated attributes in a frame, kept: [attribute][value][component], empty for those that
/// are not animated.
class KeptValues {
 public:
  KeptValues() = default;
  /// Those of the decoder's current frame.
  explicit KeptValues(const Decoder& decoder) : values_(decoder.properties().attributes.size()) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const std::span<const float> present = decoder.animated_values(i);
      values_[i].assign(present.begin(), present.end());
    }
  }

  /// As a sink takes them; valid as long as these.
  std::vector<std::span<const float>> spans() const { return {values_.begin(), values_.end()}; }

 private:
  std::vector<std::vector<float>> values_;
};

}  // namespace tvg::cli
