#pragma once
#include "base/byte_io.hpp"
#include "base/stream_error.hpp"

#include <cstdint>

#include <tvg/types.hpp>

namespace tvg {

/// §4.9: how the payload of planes that several GOPs share begins. What follows belongs to the mode.
struct PlanHeader {
  /// No longer than this, so that a reader need not hold the whole payload to know it.
  static constexpr std::size_t kMostBytes = 4 + 10 + 10;

  std::uint32_t mesh = 0;  ///< id of the mesh
  std::uint64_t adds_to = 0;
  std::uint64_t mode = 0;
};

/// Reads it from the front of a payload into `plan`.
Fault read_plan_header(Bytes payload, PlanHeader& plan);

}  // namespace tvg
