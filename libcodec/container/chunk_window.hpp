#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// The chunks of one kind that those behind them may name, by the checksums of their payloads: the latest of
/// different names, so many as the format allows (format-spec §4.3, §4.9), and what their reader or writer
/// keeps of each.
class ChunkWindow {
 public:
  struct Entry {
    std::uint32_t id = 0;                      ///< payload checksum
    std::optional<ErrorCode> fault = {};       ///< why the chunk cannot be used, if so
    std::uint64_t offset = 0;                  ///< of the latest chunk with this id
    std::uint64_t ordinal = 0;                 ///< of that chunk among those of its kind, counted from 1
    std::uint64_t number = 0;                  ///< what its user notes of it
    std::uint64_t adds_to = 0;                 ///< of planes: what their header says
    std::uint32_t part = 0;                    ///< of planes: how many chunks there are that they add to
    std::uint32_t parts_wanted = 0;            ///< of a mesh: such chunks that its reader wants; 0 for all
    std::shared_ptr<const void> content = {};  ///< what its user made of it
  };

  /// Takes a chunk in, the latest by its offset; of more than `most` the oldest goes. False where there is no
  /// memory.
  bool put(Entry entry, std::size_t most);

  /// What is in force under this name, or null; valid until the next put() or keep_only().
  Entry* find(std::uint32_t id);
  const Entry* find(std::uint32_t id) const { return const_cast<ChunkWindow*>(this)->find(id); }
  /// Whether a chunk that begins there is in force.
  bool holds(std::uint64_t offset) const;

  /// Drops all but the chunks that begin at one of these places.
  void keep_only(std::span<const std::uint64_t> offsets);

  /// As an index has it: how many chunks of the kind one goes back from the end to find this one (§4.6).
  std::uint64_t back(const Entry& entry) const { return count_ - entry.ordinal + 1; }
  /// Chunks put so far.
  std::uint64_t count() const { return count_; }
  std::span<const Entry> entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;  ///< by offset
  std::uint64_t count_ = 0;
};

}  // namespace tvg
