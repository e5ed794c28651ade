#pragma once
#include "basis/basis_fit_encode.hpp"

#include <cstdint>

namespace tvg {

/// What an effort of 1 to 9 spends time on.
struct Effort {
  std::uint32_t neighbours;     ///< of the pyramid
  std::uint32_t period_frames;  ///< of a basis
  FitEffort fit;
};

Effort effort_of(int effort);

}  // namespace tvg
