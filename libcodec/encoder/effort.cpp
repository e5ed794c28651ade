#include "encoder/effort.hpp"

#include <array>
#include <cstddef>

namespace tvg {

Effort effort_of(int effort) {
  static const std::array<Effort, 9> efforts = {{
      {8, 64, {{3}, 2}},
      {8, 64, {{3}, 3}},
      {8, 128, {{3}, 4}},
      {12, 128, {{3}, 6}},
      {16, 128, {{3}, 8}},
      {16, 128, {{3, 2}, 8}},
      {16, 128, {{3, 2, 4}, 8}},
      {16, 256, {{3, 2, 4}, 8}},
      {16, 512, {{3, 2, 4, 1.5, 2.5, 6}, 8}},
  }};
  return efforts[static_cast<std::size_t>(effort - 1)];
}

}  // namespace tvg
