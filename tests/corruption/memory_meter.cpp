#include "memory_meter.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace tvg::corruption {

namespace {

std::atomic<bool> metering = false;
std::atomic<std::ptrdiff_t> in_use = 0;  ///< may fall below zero: blocks from before the meter are freed too
std::atomic<std::ptrdiff_t> most = 0;
std::atomic<std::size_t> allocations = 0;
std::atomic<std::size_t> limit = 0;

void* allocate(std::size_t size, std::size_t alignment) {
  if (metering) {
    const std::ptrdiff_t used = std::max<std::ptrdiff_t>(in_use, 0);
    if (size > limit - std::min<std::size_t>(limit, static_cast<std::size_t>(used))) throw std::bad_alloc();
  }
  void* block = alignment == 0
                    ? std::malloc(std::max<std::size_t>(size, 1))
                    : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (block == nullptr) throw std::bad_alloc();
  if (metering) {
    ++allocations;
    const std::ptrdiff_t used = in_use += static_cast<std::ptrdiff_t>(malloc_usable_size(block));
    most = std::max<std::ptrdiff_t>(most, used);
  }
  return block;
}

void release(void* block) noexcept {
  if (metering && block != nullptr) in_use -= static_cast<std::ptrdiff_t>(malloc_usable_size(block));
  std::free(block);
}

}  // namespace

MemoryMeter::MemoryMeter(std::size_t cap) {
  in_use = 0;
  most = 0;
  allocations = 0;
  limit = cap;
  metering = true;
}

MemoryMeter::~MemoryMeter() {
  metering = false;
}

std::size_t MemoryMeter::peak() const {
  return static_cast<std::size_t>(most);
}

std::size_t MemoryMeter::count() const {
  return allocations;
}

}  // namespace tvg::corruption

void* operator new(std::size_t size) {
  return tvg::corruption::allocate(size, 0);
}
void* operator new[](std::size_t size) {
  return tvg::corruption::allocate(size, 0);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return tvg::corruption::allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return tvg::corruption::allocate(size, 0);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void* operator new[](std::size_t size, const std::nothrow_t& none) noexcept {
  return operator new(size, none);
}
void operator delete(void* block) noexcept {
  tvg::corruption::release(block);
}
void operator delete[](void* block) noexcept {
  tvg::corruption::release(block);
}
void operator delete(void* block, std::size_t) noexcept {
  tvg::corruption::release(block);
}
void operator delete[](void* block, std::size_t) noexcept {
  tvg::corruption::release(block);
}
void operator delete(void* block, std::align_val_t) noexcept {
  tvg::corruption::release(block);
}
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
  tvg::corruption::release(block);
}
void operator delete(void* block, const std::nothrow_t&) noexcept {
  tvg::corruption::release(block);
}
void operator delete[](void* block, const std::nothrow_t&) noexcept {
  tvg::corruption::release(block);
}
