#include "base/allocation.hpp"

#include <algorithm>

#include <tvg/types.hpp>

namespace tvg {

std::optional<PlaneList> PlaneList::of(std::span<const std::uint64_t> numbers) {
  if (numbers.empty()) return PlaneList();
  if (numbers.size() == 1) return PlaneList(numbers.front());
  if (!can_allocate(numbers.size_bytes() + kSmallThings)) return std::nullopt;
  PlaneList list;
  list.more_ = std::make_shared<const std::vector<std::uint64_t>>(numbers.begin(), numbers.end());
  return list;
}

bool PlaneList::operator==(const PlaneList& other) const {
  const auto own = numbers(), others = other.numbers();
  return std::equal(own.begin(), own.end(), others.begin(), others.end());
}

}  // namespace tvg
