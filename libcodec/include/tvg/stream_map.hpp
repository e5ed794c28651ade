#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tvg/types.hpp>

// Where the frames of a stream lie: its index, as bytes and as a map.
namespace tvg {

/// Size of the chunk that ends every stream and says where the index is.
inline constexpr std::size_t kTailBytes = 28;

/// Where the index chunk of a stream of `stream_size` bytes lies, from its last kTailBytes bytes. kMalformed
/// when they are no tail: the stream is cut, or still being written.
Result<ByteRange> locate_index(std::span<const std::uint8_t> tail, std::uint64_t stream_size);

/// The entries of an index chunk, from all of its bytes.
Result<std::vector<IndexEntry>> parse_index(std::span<const std::uint8_t> chunk);

/// Frames of all GOPs of an index.
std::uint64_t count_frames(std::span<const IndexEntry> index);

/// Where the chunks of a stream lie and which frames they hold: its meshes, planes and GOPs as they were met
/// while reading from its start, or all that its index has. Places are in the order of the stream.
class StreamMap {
 public:
  struct Place {
    IndexEntry entry;
    std::uint64_t first_frame = 0;  ///< position in the stream of the first frame at or behind this place
    std::optional<std::uint64_t> mesh_offset = {};  ///< of a GOP: where its mesh's chunk begins, if known
    /// Of a GOP: where the chunks of its planes begin: of all of them as an index has it, of those that were
    /// needed while reading.
    PlaneList plan_offsets = {};

    std::uint64_t end_frame() const { return first_frame + entry.frame_count; }
  };

  StreamMap() = default;
  /// The map that an index gives; empty where there is no memory for it.
  explicit StreamMap(std::span<const IndexEntry> index) { set_index(index); }

  /// Takes note of a chunk that was read; one that lies before the last one is known already, and an index
  /// knows all. False where there is no memory.
  bool note(const Place& place);
  /// Takes over an index, which knows the whole stream. False, and an empty map, where there is no memory.
  bool set_index(std::span<const IndexEntry> entries);

  /// Whether the places are those of an index.
  bool from_index() const { return from_index_; }
  std::span<const Place> places() const { return places_; }
  /// Frames up to the end of the last place.
  std::uint64_t frame_count() const { return places_.empty() ? 0 : places_.back().end_frame(); }
  /// The GOP that holds `frame`, or the last one where all end before; null where no GOP is known.
  const Place* gop_for(std::uint64_t frame) const;
  /// Where the chunks of meshes and planes begin that decoding needs which begins at this GOP of the map, of
  /// a stream with these limits, ascending: those that it and the GOPs behind it name and that lie before it;
  /// without an index the last ones too, since what follows is not known. For the coarser mesh of number
  /// `lod` (Decoder::use_lod()) so many chunks of planes at the end of those of each GOP are left out. Empty
  /// where there is no memory.
  std::vector<std::uint64_t> needed_for(const Place& gop, const StreamLimits& limits,
                                        std::uint32_t lod = 0) const;
  /// The place that begins at `offset`, or null.
  const Place* at(std::uint64_t offset) const;
  /// Whether an index says the same.
  bool matches(std::span<const IndexEntry> entries) const;

 private:
  std::vector<Place> places_;
  bool from_index_ = false;
};

}  // namespace tvg
