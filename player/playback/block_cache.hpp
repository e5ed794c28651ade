#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <tvg/decoder.hpp>

namespace tvg::player {

/// Bytes of a stream that came in any order, as many as memory is given for. Those used longest ago go first,
/// but not those that the reader comes to next.
class BlockCache {
 public:
  static constexpr std::uint64_t kBlockBytes = std::uint64_t{1} << 16;

  /// Holds at most `limit` bytes, rounded to blocks, at least 4 blocks.
  explicit BlockCache(std::uint64_t limit);

  /// Adds the bytes at `offset`. `reader` is where reading goes on.
  void write(std::uint64_t offset, std::span<const std::uint8_t> bytes, std::uint64_t reader);
  /// Copies what is there from `offset` on, up to the size of `target`: how many bytes.
  std::size_t read(std::uint64_t offset, std::span<std::uint8_t> target);
  /// The first offset from `offset` on that is not there.
  std::uint64_t first_missing(std::uint64_t offset) const;
  /// What is there, in ascending order.
  std::vector<ByteRange> ranges() const;
  void clear() { blocks_.clear(); }

 private:
  /// The bytes [begin, end) of a block: one run, since transfers bring runs.
  struct Block {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::uint64_t used = 0;
    std::vector<std::uint8_t> bytes;
  };

  void write_block(std::uint64_t index, std::size_t at, std::span<const std::uint8_t> bytes);
  void make_room(std::uint64_t index, std::uint64_t reader);

  std::map<std::uint64_t, Block> blocks_;
  std::size_t most_blocks_;
  std::uint64_t uses_ = 0;
};

}  // namespace tvg::player
