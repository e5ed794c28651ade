#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <tvg/tvg.h>
#include <tvg/types.hpp>

// What both directions of the C interface share.
namespace tvg::c_api {

static_assert(sizeof(Face) == 3 * sizeof(std::uint32_t), "faces are handed over as they are");

inline tvg_code code_of(const Error& error) {
  return static_cast<tvg_code>(static_cast<int>(error.code));
}

/// Gives the caller as much of a structure as he knows.
template <class Info>
tvg_code give(Info info, Info* target) {
  static_assert(std::is_trivially_copyable_v<Info>);
  if (target == nullptr || target->struct_size < sizeof(std::size_t)) return TVG_ERROR_INVALID_ARGUMENT;
  info.struct_size = std::min(target->struct_size, sizeof(Info));
  std::memcpy(static_cast<void*>(target), &info, info.struct_size);
  return TVG_OK;
}

/// Whether `size` bytes hold three floats for every vertex, `stride` bytes apart.
inline bool fits(std::uint64_t vertex_count, const void* target, std::size_t size, std::size_t stride) {
  if (target == nullptr || stride < 12 || size < 12) return false;
  return vertex_count <= (size - 12) / stride + 1;
}

}  // namespace tvg::c_api
