#pragma once
#include <cstddef>

namespace tvg::corruption {

/// Measures what `operator new` gives out while it lives, in the whole program: link memory_meter.cpp, which
/// replaces it. Above `cap` bytes allocations fail. One meter at a time; threads are not told apart.
class MemoryMeter {
 public:
  explicit MemoryMeter(std::size_t cap = static_cast<std::size_t>(-1));
  ~MemoryMeter();
  MemoryMeter(const MemoryMeter&) = delete;
  MemoryMeter& operator=(const MemoryMeter&) = delete;

  /// The most bytes that were allocated at once, without those from before the meter began.
  std::size_t peak() const;
  /// Allocations so far.
  std::size_t count() const;
};

}  // namespace tvg::corruption
