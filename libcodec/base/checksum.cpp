#define XXH_INLINE_ALL
#include "base/checksum.hpp"

#include <algorithm>
#include <bit>
#include <new>
#include <xxhash.h>

namespace tvg {

namespace {

XXH64_state_t* state_in(std::array<std::byte, 88>& storage) {
  return std::launder(reinterpret_cast<XXH64_state_t*>(storage.data()));
}

}  // namespace

std::uint32_t checksum(std::span<const std::uint8_t> bytes, std::uint64_t seed) {
  return static_cast<std::uint32_t>(XXH64(bytes.data(), bytes.size(), seed));
}

Hasher::Hasher() {
  static_assert(sizeof(XXH64_state_t) <= sizeof(state_) && alignof(XXH64_state_t) <= 8);
  new (state_.data()) XXH64_state_t;
  XXH64_reset(state_in(state_), 0);
}

void Hasher::update(std::span<const std::uint8_t> bytes) {
  XXH64_update(state_in(state_), bytes.data(), bytes.size());
}

void Hasher::update(std::span<const std::int32_t> values) {
  if constexpr (std::endian::native == std::endian::little) {
    XXH64_update(state_in(state_), values.data(), values.size_bytes());
  } else {
    std::array<std::uint8_t, 256> piece;
    for (std::size_t begin = 0; begin < values.size(); begin += piece.size() / 4) {
      const auto some = values.subspan(begin, std::min(values.size() - begin, piece.size() / 4));
      for (std::size_t i = 0; i < 4 * some.size(); ++i) {
        piece[i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(some[i / 4]) >> (8 * (i % 4)));
      }
      XXH64_update(state_in(state_), piece.data(), 4 * some.size());
    }
  }
}

std::uint64_t Hasher::value() const {
  auto copy = state_;
  return XXH64_digest(state_in(copy));
}

}  // namespace tvg
