#include "player/playback/block_cache.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace tvg::player {

BlockCache::BlockCache(std::uint64_t limit)
    : most_blocks_(static_cast<std::size_t>(std::max<std::uint64_t>(limit / kBlockBytes, 4))) {}

void BlockCache::write(std::uint64_t offset, std::span<const std::uint8_t> bytes, std::uint64_t reader) {
  while (!bytes.empty()) {
    const std::uint64_t index = offset / kBlockBytes;
    const auto at = static_cast<std::size_t>(offset % kBlockBytes);
    const std::size_t count = std::min(bytes.size(), static_cast<std::size_t>(kBlockBytes) - at);
    make_room(index, reader);
    write_block(index, at, bytes.first(count));
    bytes = bytes.subspan(count);
    offset += count;
  }
}

void BlockCache::write_block(std::uint64_t index, std::size_t at, std::span<const std::uint8_t> bytes) {
  Block& block = blocks_[index];
  if (block.bytes.empty()) block.bytes.resize(static_cast<std::size_t>(kBlockBytes));
  std::memcpy(block.bytes.data() + at, bytes.data(), bytes.size());
  const std::size_t end = at + bytes.size();
  const bool touches = block.begin < block.end && at <= block.end && end >= block.begin;
  block.begin = touches ? std::min(block.begin, at) : at;
  block.end = touches ? std::max(block.end, end) : end;
  block.used = ++uses_;
}

void BlockCache::make_room(std::uint64_t index, std::uint64_t reader) {
  if (blocks_.size() < most_blocks_ || blocks_.contains(index)) return;
  const std::uint64_t next = reader / kBlockBytes;
  auto victim = blocks_.end();
  for (auto at = blocks_.begin(); at != blocks_.end(); ++at) {
    const bool wanted_soon = at->first >= next && at->first - next < most_blocks_ / 2;
    if (!wanted_soon && (victim == blocks_.end() || at->second.used < victim->second.used)) victim = at;
  }
  blocks_.erase(victim == blocks_.end() ? std::prev(blocks_.end()) : victim);
}

std::size_t BlockCache::read(std::uint64_t offset, std::span<std::uint8_t> target) {
  std::size_t done = 0;
  while (done < target.size()) {
    const std::uint64_t from = offset + done;
    const auto found = blocks_.find(from / kBlockBytes);
    const auto at = static_cast<std::size_t>(from % kBlockBytes);
    if (found == blocks_.end() || at < found->second.begin || at >= found->second.end) break;
    Block& block = found->second;
    const std::size_t count = std::min(target.size() - done, block.end - at);
    std::memcpy(target.data() + done, block.bytes.data() + at, count);
    block.used = ++uses_;
    done += count;
  }
  return done;
}

std::uint64_t BlockCache::first_missing(std::uint64_t offset) const {
  for (;;) {
    const auto found = blocks_.find(offset / kBlockBytes);
    const auto at = static_cast<std::size_t>(offset % kBlockBytes);
    if (found == blocks_.end() || at < found->second.begin || at >= found->second.end) return offset;
    offset += found->second.end - at;
  }
}

std::vector<ByteRange> BlockCache::ranges() const {
  std::vector<ByteRange> ranges;
  for (const auto& [index, block] : blocks_) {
    const std::uint64_t from = index * kBlockBytes + block.begin;
    const std::uint64_t count = block.end - block.begin;
    if (!ranges.empty() && ranges.back().offset + ranges.back().size == from) {
      ranges.back().size += count;
    } else {
      ranges.push_back({from, count});
    }
  }
  return ranges;
}

}  // namespace tvg::player
