#pragma once
#include "base/allocation.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tvg {

/// The chunks of one kind that those behind them may name, by the checksums of their payloads: the latest of
/// different names, so many as the format allows (format-spec §4.3, §4.9). `Value` is what is kept of each.
template <class Value>
class ChunkWindow {
 public:
  struct Entry {
    std::uint32_t id = 0;       ///< payload checksum
    std::uint64_t offset = 0;   ///< of the latest chunk with this id
    std::uint64_t ordinal = 0;  ///< of that chunk among those of its kind, counted from 1
    Value value{};
  };

  /// Takes a chunk in, the latest by its offset; of more than `most` the oldest goes. False where there is no
  /// memory.
  bool put(std::uint32_t id, std::uint64_t offset, Value value, std::size_t most) {
    ++count_;
    if (Entry* const known = find(id)) erase(known);
    while (!entries_.empty() && entries_.size() >= most) erase(&entries_.front());
    if (!try_grow(entries_, 1)) return false;
    const auto behind =
        std::upper_bound(entries_.begin(), entries_.end(), offset,
                         [](std::uint64_t o, const Entry& entry) { return o < entry.offset; });
    entries_.insert(behind, Entry{id, offset, count_, std::move(value)});
    return true;
  }

  /// What is in force under this name, or null; valid until the next put() or keep_only().
  Entry* find(std::uint32_t id) {
    const auto found =
        std::find_if(entries_.rbegin(), entries_.rend(), [id](const Entry& entry) { return entry.id == id; });
    return found == entries_.rend() ? nullptr : &*found;
  }
  const Entry* find(std::uint32_t id) const { return const_cast<ChunkWindow*>(this)->find(id); }
  /// Whether a chunk that begins there is in force.
  bool holds(std::uint64_t offset) const {
    return std::any_of(entries_.begin(), entries_.end(),
                       [offset](const Entry& entry) { return entry.offset == offset; });
  }

  /// Drops all but the chunks that begin at one of these places.
  void keep_only(std::span<const std::uint64_t> offsets) {
    const auto goes = [offsets](const Entry& entry) {
      return std::find(offsets.begin(), offsets.end(), entry.offset) == offsets.end();
    };
    entries_.erase(std::remove_if(entries_.begin(), entries_.end(), goes), entries_.end());
  }

  /// As an index has it: how many chunks of the kind one goes back from the end to find this one (§4.6).
  std::uint64_t back(const Entry& entry) const { return count_ - entry.ordinal + 1; }
  /// Chunks put so far.
  std::uint64_t count() const { return count_; }
  std::span<const Entry> entries() const { return entries_; }

 private:
  void erase(Entry* entry) { entries_.erase(entries_.begin() + (entry - entries_.data())); }

  std::vector<Entry> entries_;  ///< by offset
  std::uint64_t count_ = 0;
};

}  // namespace tvg
