#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include <tvg/data.hpp>
#include <tvg/tvg.h>
#include <tvg/types.hpp>

// What both directions of the C interface share.
namespace tvg::c_api {

static_assert(sizeof(Face) == 3 * sizeof(std::uint32_t), "faces are handed over as they are");

inline tvg_code code_of(const Error& error) {
  return static_cast<tvg_code>(static_cast<int>(error.code));
}

/// Undoes the encoding of free-form data, into `bytes`, which are as many as they say: TVG_ERROR_UNSUPPORTED
/// where this library cannot. A library that only decodes has no decompressor.
tvg_code unpack_into(const CodedData& data, std::span<std::uint8_t> bytes);

/// Gives the caller as much of a structure as he knows.
template <class Info>
tvg_code give(Info info, Info* target) {
  static_assert(std::is_trivially_copyable_v<Info>);
  if (target == nullptr || target->struct_size < sizeof(std::size_t)) return TVG_ERROR_INVALID_ARGUMENT;
  info.struct_size = std::min(target->struct_size, sizeof(Info));
  std::memcpy(static_cast<void*>(target), &info, info.struct_size);
  return TVG_OK;
}

/// Whether `size` bytes hold `count` rows of `components` floats, `stride` bytes apart.
inline bool fits(std::uint64_t count, const void* target, std::size_t size, std::size_t stride,
                 std::size_t components = 3) {
  const std::size_t row = components * sizeof(float);
  if (count == 0) return stride >= row;
  if (target == nullptr || stride < row || size < row) return false;
  return count <= (size - row) / stride + 1;
}

}  // namespace tvg::c_api
