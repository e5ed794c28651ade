#pragma once
#include <cstdint>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// Where the meshes and GOPs of a stream lie: as they were met while reading from its start, or as its index
/// says. Places are in the order of the stream.
class StreamMap {
 public:
  struct Place {
    IndexEntry entry;
    std::uint64_t first_frame = 0;  ///< position in the stream of the first frame at or behind this place

    std::uint64_t end_frame() const { return first_frame + entry.frame_count; }
  };

  /// Takes note of a chunk that was read; one that lies before the last one is known already.
  void note(const IndexEntry& entry, std::uint64_t first_frame);
  /// Takes over an index, which knows the whole stream.
  void set_index(const std::vector<IndexEntry>& entries);

  /// Whether the places are those of an index.
  bool from_index() const { return from_index_; }
  std::size_t size() const { return places_.size(); }
  /// Frames up to the end of the last place.
  std::uint64_t frame_count() const { return places_.empty() ? 0 : places_.back().end_frame(); }
  /// The GOP that holds `frame`, or the last one where all end before; null where no GOP is known.
  const Place* gop_for(std::uint64_t frame) const;
  /// The mesh of a GOP; null where the stream gives it none.
  const Place* mesh_of(const Place& gop) const;
  /// The place that begins at `offset`, or null.
  const Place* at(std::uint64_t offset) const;
  /// Whether an index says the same.
  bool matches(const std::vector<IndexEntry>& entries) const;

 private:
  std::vector<Place> places_;
  bool from_index_ = false;
};

}  // namespace tvg
