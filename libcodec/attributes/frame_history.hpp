#pragma once
#include <cstdint>
#include <span>

namespace tvg {

/// The values of the frames before, [value][integer].
struct FrameHistory {
  std::span<const std::int32_t> before;  ///< empty: values stand for themselves
  std::span<const std::int32_t> older;   ///< those of the frame before that; empty where there is none
};

}  // namespace tvg
