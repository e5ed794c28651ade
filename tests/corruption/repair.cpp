#include "repair.hpp"

#include "base/checksum.hpp"
#include "container/chunk.hpp"
#include "container/packet.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace tvg::corruption {

namespace {

constexpr std::size_t kLengthOffset = 8;
constexpr std::size_t kHeaderChecksumOffset = 12;

void put_u32(std::span<std::uint8_t> target, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) target[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

std::uint32_t get_u32(Bytes source) {
  return ByteReader(source).u32();
}

bool known_type_at(Bytes bytes) {
  constexpr std::array kKnown = {kHeadChunk, kMetadataChunk, kDataChunk,  kMeshChunk,
                                 kPlanChunk, kGopChunk,      kIndexChunk, kTailChunk};
  return std::any_of(kKnown.begin(), kKnown.end(), [bytes](const ChunkType& type) {
    return std::equal(type.begin(), type.end(), bytes.begin(), [](char letter, std::uint8_t byte) {
      return static_cast<std::uint8_t>(letter) == byte;
    });
  });
}

std::vector<Extent> find_packets(Bytes stream, Extent payload) {
  std::vector<Extent> packets;
  while (payload.size > 0) {
    ByteReader reader(stream.subspan(payload.begin, payload.size));
    reader.u8();
    reader.bytes(reader.varint());
    reader.u32();
    if (!reader.ok()) break;
    packets.push_back({payload.begin, reader.position()});
    payload = {payload.begin + reader.position(), payload.size - reader.position()};
  }
  return packets;
}

}  // namespace

std::vector<ChunkExtent> find_chunks(std::span<const std::uint8_t> stream) {
  std::vector<ChunkExtent> chunks;
  constexpr std::size_t kFrame = kChunkHeaderSize + kChunkChecksumSize;
  for (std::size_t begin = kSignature.size(); begin <= stream.size() && stream.size() - begin >= kFrame;) {
    const std::uint32_t length = get_u32(stream.subspan(begin + kLengthOffset));
    if (length > stream.size() - begin - kFrame) break;
    ChunkExtent chunk{static_cast<char>(stream[begin]), {begin, kFrame + length}, {}};
    if (chunk.type == 'G') chunk.packets = find_packets(stream, {begin + kChunkHeaderSize, length});
    begin = chunk.whole.end();
    chunks.push_back(std::move(chunk));
  }
  return chunks;
}

void repair_lengths(std::span<std::uint8_t> stream) {
  constexpr std::size_t kFrame = kChunkHeaderSize + kChunkChecksumSize;
  for (std::size_t begin = kSignature.size(); begin + kFrame <= stream.size();) {
    std::size_t next = begin + kFrame;
    while (next + kFrame <= stream.size() && !known_type_at(stream.subspan(next))) ++next;
    if (next + kFrame > stream.size()) next = stream.size();
    put_u32(stream.subspan(begin + kLengthOffset), static_cast<std::uint32_t>(next - begin - kFrame));
    begin = next;
  }
}

namespace {

using Names = std::map<std::uint32_t, std::uint32_t>;

/// Where the first four bytes are a name that has changed, it becomes the new one.
void rename(std::span<std::uint8_t> name, const Names& names) {
  const auto renamed = name.size() >= 4 ? names.find(get_u32(name)) : names.end();
  if (renamed != names.end()) put_u32(name, renamed->second);
}

/// The planes that a GOP names, in what its header has behind the name of the mesh.
void rename_planes(std::span<std::uint8_t> fields, const Names& names) {
  ByteReader reader(fields);
  for (int i = 0; i < 3; ++i) reader.varint();
  const std::uint64_t planes = reader.varint();
  for (std::uint64_t i = 0; i < planes && reader.ok() && reader.left() >= 4; ++i) {
    rename(fields.subspan(reader.position()), names);
    reader.u32();
  }
}

/// The GOP's packets, and the mesh and the planes they name where these have other names now.
void repair_packets(std::span<std::uint8_t> stream, const ChunkExtent& gop, const Names& names) {
  std::uint32_t header_checksum = 0;
  for (std::size_t k = 0; k < gop.packets.size(); ++k) {
    const auto packet = stream.subspan(gop.packets[k].begin, gop.packets[k].size);
    if (k == 0) {
      ByteReader reader(packet);
      reader.u8();
      reader.varint();
      const auto name = packet.subspan(std::min(reader.position(), packet.size()));
      rename(name, names);
      if (name.size() >= 4) rename_planes(name.subspan(4), names);
    }
    const std::uint64_t seed = k == 0 ? 0 : packet_seed(header_checksum, static_cast<std::uint32_t>(k));
    const std::uint32_t sum = checksum(packet.first(packet.size() - kChunkChecksumSize), seed);
    if (k == 0) header_checksum = sum;
    put_u32(packet.last(kChunkChecksumSize), sum);
  }
}

}  // namespace

void repair_checksums(std::span<std::uint8_t> stream) {
  Names names;  ///< of meshes and planes: what they were, what they are
  for (const ChunkExtent& chunk : find_chunks(stream)) {
    const auto bytes = stream.subspan(chunk.whole.begin, chunk.whole.size);
    put_u32(bytes.subspan(kHeaderChecksumOffset), checksum(bytes.first(kHeaderChecksumOffset)));
    repair_packets(stream, chunk, names);
    const std::optional<ChunkHeader> header = read_chunk_header(bytes);
    const bool is_plan = header && header->type == kPlanChunk;
    if (is_plan) rename(bytes.subspan(kChunkHeaderSize), names);
    const auto sum = bytes.last(kChunkChecksumSize);
    const std::uint32_t before = get_u32(sum);
    put_u32(sum, checksum(bytes.subspan(kChunkHeaderSize, bytes.size() - kLeastChunkSize)));
    if (is_plan || (header && header->type == kMeshChunk)) names[before] = get_u32(sum);
  }
}

}  // namespace tvg::corruption
