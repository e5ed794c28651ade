#include "container/chunk_window.hpp"

#include "base/allocation.hpp"

#include <iterator>
#include <utility>

namespace tvg {

bool ChunkWindow::put(Entry entry, std::size_t most) {
  entry.ordinal = ++count_;
  if (Entry* const known = find(entry.id)) entries_.erase(entries_.begin() + (known - entries_.data()));
  if (entries_.size() >= most) entries_.erase(entries_.begin());
  if (!try_grow(entries_, 1)) return false;
  auto place = entries_.end();
  while (place != entries_.begin() && std::prev(place)->offset > entry.offset) --place;
  entries_.insert(place, std::move(entry));
  return true;
}

ChunkWindow::Entry* ChunkWindow::find(std::uint32_t id) {
  for (std::size_t i = entries_.size(); i-- > 0;) {
    if (entries_[i].id == id) return &entries_[i];
  }
  return nullptr;
}

bool ChunkWindow::holds(std::uint64_t offset) const {
  for (const Entry& entry : entries_) {
    if (entry.offset == offset) return true;
  }
  return false;
}

void ChunkWindow::keep_only(std::span<const std::uint64_t> offsets) {
  for (std::size_t i = entries_.size(); i-- > 0;) {
    bool stays = false;
    for (const std::uint64_t offset : offsets) stays = stays || offset == entries_[i].offset;
    if (!stays) entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace tvg
