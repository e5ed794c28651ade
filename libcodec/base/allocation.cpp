#include "base/allocation.hpp"

#include <new>

namespace tvg {

// Here and not in the header, so that no compiler takes the pair for one that need not be.
bool can_allocate(std::size_t bytes) noexcept {
  void* const memory = ::operator new(bytes, std::nothrow);
  ::operator delete(memory, std::nothrow);
  return memory != nullptr;
}

}  // namespace tvg
