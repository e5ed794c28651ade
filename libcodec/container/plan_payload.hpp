#pragma once
#include "base/byte_io.hpp"
#include "base/stream_error.hpp"

#include <cstdint>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// §4.9: planes that several GOPs share, as far as they do not depend on the mode.
struct PlanHeader {
  std::uint32_t mesh = 0;     ///< id of the mesh
  std::uint64_t adds_to = 0;  ///< 0, or 1 more than the name of the planes that these add to
  std::uint64_t mode = 0;
  Bytes fields;  ///< those of the mode
};

/// Planes and the GOPs that may name them have the same: their mesh and their mode, one of those above 0.
/// That of no known mode is that of another.
constexpr std::uint64_t owner_of_planes(std::uint32_t mesh, std::uint64_t mode) {
  constexpr std::uint64_t kMost = 0xFFFFFFFF;
  return std::uint64_t{mesh} << 32 | (mode < kMost ? mode : kMost);
}

/// Bytes of a payload from which the fields above can be read.
inline constexpr std::size_t kPlanHeaderBytes = 4 + 10 + 10;

std::vector<std::uint8_t> write_plan(const PlanHeader& plan);
/// Reads a payload into `plan`.
Fault read_plan(Bytes payload, PlanHeader& plan);

}  // namespace tvg
