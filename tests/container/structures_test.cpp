#include "base/checksum.hpp"
#include "container/chunk.hpp"
#include "container/gop_header.hpp"
#include "container/head.hpp"
#include "container/index.hpp"
#include "container/mesh_payload.hpp"
#include "container/metadata.hpp"
#include "container/packet.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include <tvg/decoder.hpp>

namespace tvg {
namespace {

using Buffer = std::vector<std::uint8_t>;

template <class T>
void expect_refused(const Result<T>& result, ErrorCode code, const std::string& section) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, code) << result.error().message;
  EXPECT_EQ(result.error().section, section);
  EXPECT_FALSE(result.error().message.empty());
}

/// Every truncation, and one byte more, is refused.
template <class Read>
void expect_exact_length(const Buffer& good, Read read) {
  ASSERT_TRUE(read(good));
  for (std::size_t length = 0; length < good.size(); ++length) {
    const Buffer cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_FALSE(read(cut)) << length;
  }
  Buffer longer = good;
  longer.push_back(0);
  EXPECT_FALSE(read(longer));
}

TEST(ChunkHeader, ComesBackWithItsWholeSize) {
  const Buffer chunk = write_chunk(kGopChunk, true, Buffer{1, 2, 3});
  ASSERT_EQ(chunk.size(), 23u);
  const std::optional<ChunkHeader> header = read_chunk_header(chunk);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->type, kGopChunk);
  EXPECT_TRUE(header->ancillary);
  EXPECT_EQ(header->length, 3u);
  EXPECT_EQ(header->total_size(), 23u);
  EXPECT_FALSE(read_chunk_header(write_chunk(kHeadChunk, false, {}))->ancillary);
}

TEST(ChunkHeader, EverySingleByteChangeIsRefused) {
  const Buffer good = write_chunk(kMeshChunk, false, Buffer(5, 9));
  for (std::size_t i = 0; i < kChunkHeaderSize; ++i) {
    for (int change = 1; change < 256; ++change) {
      Buffer bytes = good;
      bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ change);
      EXPECT_FALSE(read_chunk_header(bytes)) << i;
    }
  }
  for (std::size_t length = 0; length < kChunkHeaderSize; ++length) {
    EXPECT_FALSE(read_chunk_header(Bytes(good).first(length)));
  }
}

TEST(ChunkHeader, ReservedBitsLettersAndLengthAreRefusedThoughTheChecksumFits) {
  const auto header = [](std::array<std::uint8_t, 4> type, std::uint32_t flags, std::uint32_t length) {
    ByteWriter writer;
    writer.bytes(type);
    writer.u32(flags);
    writer.u32(length);
    writer.u32(checksum(writer.data()));
    return read_chunk_header(writer.data()).has_value();
  };
  EXPECT_TRUE(header({'A', 'b', '1', ' '}, 1, kMaxChunkLength));
  EXPECT_FALSE(header({'A', 'b', '1', ' '}, 2, 0));
  EXPECT_FALSE(header({'A', 'b', '1', ' '}, 0x80000000, 0));
  EXPECT_FALSE(header({'A', 'b', '1', 0x1F}, 0, 0));
  EXPECT_FALSE(header({'A', 'b', 0x7F, ' '}, 0, 0));
  EXPECT_FALSE(header({0xC3, 'b', '1', ' '}, 0, 0));
  EXPECT_FALSE(header({'A', 'b', '1', ' '}, 0, kMaxChunkLength + 1));
}

StreamLimits some_limits() {
  StreamLimits limits{1000, 2000, 50, 24256, 0};
  limits.decoder_memory = decoder_memory_needed(limits);
  return limits;
}

TEST(Head, ComesBack) {
  const Buffer bytes = write_head(some_limits());
  const Result<StreamHead> head = read_head(bytes);
  ASSERT_TRUE(head);
  EXPECT_EQ(head->limits, some_limits());
  EXPECT_EQ(head->major, kFormatMajor);
  EXPECT_EQ(head->minor, kFormatMinor);
  expect_exact_length(bytes, read_head);
}

TEST(Head, AnotherVersionReservedBitsOrUndueMemoryAreRefused) {
  const Buffer good = write_head(some_limits());
  const auto with = [&](std::size_t at, std::uint8_t value) {
    Buffer bytes = good;
    bytes[at] = value;
    return read_head(bytes);
  };
  expect_refused(with(0, kFormatMajor + 1), ErrorCode::kUnsupportedVersion, "§4.1");
  expect_refused(with(2, kFormatMinor + 1), ErrorCode::kUnsupportedVersion, "§4.1");
  EXPECT_NE(with(2, 99).error().message.find("99"), std::string::npos) << "the version is named";
  for (std::size_t at = 4; at < 8; ++at) expect_refused(with(at, 1), ErrorCode::kMalformed, "§4.1");
  expect_refused(with(24, static_cast<std::uint8_t>(good[24] + 1)), ErrorCode::kMalformed, "§4.1");
}

TEST(MetadataLayout, ComesBackInUtf8) {
  const Metadata metadata = {{"fps", "30000/1001"}, {"name", "Hühnchen 🐔"}, {"ключ", ""}};
  const Buffer bytes = write_metadata(metadata);
  const Result<Metadata> back = read_metadata(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, metadata);
  expect_exact_length(bytes, read_metadata);
  EXPECT_TRUE(read_metadata(write_metadata({})));
}

TEST(MetadataLayout, EmptyDoubleOrUnorderedKeysAndUndueCountsAreRefused) {
  const auto read = [](std::uint64_t count, const std::vector<std::string>& texts) {
    ByteWriter writer;
    writer.varint(count);
    for (const std::string& text : texts) {
      writer.varint(text.size());
      for (const char c : text) writer.u8(static_cast<std::uint8_t>(c));
    }
    return read_metadata(writer.data());
  };
  EXPECT_TRUE(read(2, {"a", "1", "b", "2"}));
  expect_refused(read(1, {"", "1"}), ErrorCode::kMalformed, "§4.2");
  expect_refused(read(2, {"a", "1", "a", "2"}), ErrorCode::kMalformed, "§4.2");
  expect_refused(read(2, {"b", "1", "a", "2"}), ErrorCode::kMalformed, "§4.2");
  expect_refused(read(1, {"a", "1", "b", "2"}), ErrorCode::kMalformed, "§4.2");
  expect_refused(read(~std::uint64_t{0}, {"a", "1"}), ErrorCode::kMalformed, "§4.2");
}

TEST(MetadataLayout, WhatIsNoTextInUtf8IsRefused) {
  const std::string bad[] = {
      std::string("a\0b", 3),  // cannot be asked for through the C interface
      "\x80",                  // a continuation first
      "\xC3",                  // cut
      "\xC3(",                 // not continued
      "\xC0\xAF",              // over-long forms
      "\xE0\x9F\xBF",          //
      "\xF0\x8F\xBF\xBF",      //
      "\xED\xA0\x80",          // a surrogate
      "\xF4\x90\x80\x80",      // above U+10FFFF
      "\xFF",                  //
  };
  for (const std::string& text : bad) {
    expect_refused(read_metadata(write_metadata({{text, "value"}})), ErrorCode::kMalformed, "§4.2");
    expect_refused(read_metadata(write_metadata({{"key", text}})), ErrorCode::kMalformed, "§4.2");
  }
  EXPECT_TRUE(read_metadata(write_metadata({{"\t\xDF\xBF\xEF\xBF\xBF", "\xF4\x8F\xBF\xBF\n"}})));
}

TEST(MeshChunk, ComesBack) {
  const Buffer connectivity = {1, 2, 3}, order = {4, 5};
  const Buffer bytes = write_mesh({1000, 0, true, connectivity, order});
  const Result<MeshLayout> mesh = read_mesh(bytes);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->vertex_count, 1000u);
  EXPECT_EQ(mesh->face_count, 0u);
  EXPECT_TRUE(mesh->keeps_order);
  EXPECT_EQ(Buffer(mesh->connectivity.begin(), mesh->connectivity.end()), connectivity);
  EXPECT_EQ(Buffer(mesh->order.begin(), mesh->order.end()), order);
  EXPECT_TRUE(read_mesh(write_mesh({1, 1, false, connectivity, {}})));
}

TEST(MeshChunk, CountsFlagsAndSizesOutOfRangeAreRefused) {
  const auto read = [](std::uint64_t vertices, std::uint64_t faces, std::uint8_t order, std::uint64_t size,
                       std::size_t bytes_after) {
    ByteWriter writer;
    writer.varint(vertices);
    writer.varint(faces);
    writer.u8(order);
    writer.varint(size);
    writer.bytes(Buffer(bytes_after, 7));
    return read_mesh(writer.data()).operator bool() ? Result<bool>(true)
                                                    : Result<bool>(read_mesh(writer.data()).error());
  };
  EXPECT_TRUE(read(5, 5, 1, 3, 4));
  expect_refused(read(0, 5, 1, 3, 4), ErrorCode::kMalformed, "§4.3");
  expect_refused(read(0x80000000, 5, 1, 3, 4), ErrorCode::kMalformed, "§4.3");
  expect_refused(read(std::uint64_t{1} << 32 | 5, 5, 1, 3, 4), ErrorCode::kMalformed, "§4.3");
  expect_refused(read(5, 0x80000000, 1, 3, 4), ErrorCode::kMalformed, "§4.3");
  expect_refused(read(5, 5, 2, 3, 4), ErrorCode::kMalformed, "§4.3");
  expect_refused(read(5, 5, 1, 5, 4), ErrorCode::kMalformed, "§4.3");
  expect_refused(read(5, 5, 0, 3, 4), ErrorCode::kMalformed, "§4.3");
  expect_refused(read_mesh(Buffer{5, 5}), ErrorCode::kMalformed, "§4.3");
}

GopHeader some_gop() {
  return {12, 50, 2, 13, 11, {-1.5, 0, 2}, 0.125, {}};
}

TEST(GopHeaderPacket, ComesBack) {
  GopHeader header = some_gop();
  const Buffer flags = {8, 9};
  header.flags = flags;
  const Buffer bytes = write_gop_header(header);
  const Result<GopHeader> back = read_gop_header(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->first_frame, 12u);
  EXPECT_EQ(back->frame_count, 50u);
  EXPECT_EQ(back->predictor, 2);
  EXPECT_EQ(back->fine_bits, 13);
  EXPECT_EQ(back->coarse_bits, 11);
  EXPECT_EQ(back->origin, header.origin);
  EXPECT_EQ(back->step, 0.125);
  EXPECT_EQ(Buffer(back->flags.begin(), back->flags.end()), flags);
}

TEST(GopHeaderPacket, EveryFieldOutOfRangeIsRefused) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Buffer one_byte = {0};
  const std::vector<std::pair<const char*, std::function<void(GopHeader&)>>> faults = {
      {"predictor", [](GopHeader& h) { h.predictor = 3; }},
      {"no bits", [](GopHeader& h) { h.fine_bits = h.coarse_bits = 0; }},
      {"coarse 0", [](GopHeader& h) { h.coarse_bits = 0; }},
      {"25 bits", [](GopHeader& h) { h.fine_bits = 25; }},
      {"coarse above fine", [](GopHeader& h) { h.coarse_bits = 14; }},
      {"origin", [](GopHeader& h) { h.origin[2] = kInf; }},
      {"origin nan", [](GopHeader& h) { h.origin[0] = kNan; }},
      {"step 0", [](GopHeader& h) { h.step = 0; }},
      {"step below 0", [](GopHeader& h) { h.step = -1; }},
      {"step nan", [](GopHeader& h) { h.step = kNan; }},
      {"step infinite", [](GopHeader& h) { h.step = kInf; }},
      {"no frames", [](GopHeader& h) { h.frame_count = 0; }},
      {"first frame", [](GopHeader& h) { h.first_frame = (std::uint64_t{1} << 62) + 1; }},
      {"flags of one lattice", [&](GopHeader& h) { h.coarse_bits = 13, h.flags = one_byte; }},
  };
  ASSERT_TRUE(read_gop_header(write_gop_header(some_gop())));
  for (const auto& [name, fault] : faults) {
    SCOPED_TRACE(name);
    GopHeader header = some_gop();
    fault(header);
    expect_refused(read_gop_header(write_gop_header(header)), ErrorCode::kMalformed, "§4.5.1");
  }
  const Buffer good = write_gop_header(some_gop());
  Buffer mode = good;
  mode[0] = 1;
  expect_refused(read_gop_header(mode), ErrorCode::kMalformed, "§4.5.1");
  for (std::size_t length = 0; length < good.size(); ++length) {
    expect_refused(read_gop_header(Bytes(good).first(length)), ErrorCode::kMalformed, "§4.5.1");
  }
}

TEST(Packet, ChecksumKnowsThePlaceAndTheGop) {
  const Buffer bytes = {1, 2, 3};
  EXPECT_NE(checksum(bytes, packet_seed(7, 3, 1)), checksum(bytes, packet_seed(7, 3, 2)));
  EXPECT_NE(checksum(bytes, packet_seed(7, 3, 1)), checksum(bytes, packet_seed(8, 3, 1)));
  EXPECT_NE(checksum(bytes, packet_seed(7, 3, 1)), checksum(bytes, packet_seed(7, 4, 1)));
  ByteWriter gop;
  write_packet(gop, packet_seed(7, 3, 1), bytes);
  ByteReader reader(gop.data());
  EXPECT_EQ(reader.varint(), 3u);
  EXPECT_EQ(reader.bytes(3).front(), 1);
  EXPECT_EQ(reader.u32(), checksum(bytes, packet_seed(7, 3, 1)));
  EXPECT_TRUE(reader.finished());
}

const std::vector<IndexEntry> kEntries = {{IndexEntry::Kind::kMesh, 100, 0},
                                          {IndexEntry::Kind::kGop, 400, 50},
                                          {IndexEntry::Kind::kGop, 9000000000, 0xFFFFFFFF}};

TEST(Index, ComesBack) {
  const Buffer bytes = write_index(kEntries);
  const Result<std::vector<IndexEntry>> back = read_index(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, kEntries);
  expect_exact_length(bytes, [](Bytes some) { return read_index(some); });
  EXPECT_TRUE(read_index(write_index({})));
}

TEST(Index, UndueCountsDistancesAndFramesAreRefused) {
  const auto read = [](const std::vector<std::uint64_t>& varints) {
    ByteWriter writer;
    for (const std::uint64_t value : varints) writer.varint(value);
    return read_index(writer.data());
  };
  EXPECT_TRUE(read({2, 0, 10, 5, 20}));
  expect_refused(read({2, 0, 10, 5, 0}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({2, 0, 10, 0x100000000, 20}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({1, 0, (std::uint64_t{1} << 62) + 1}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({2, 0, std::uint64_t{1} << 62, 5, 1}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({std::uint64_t{1} << 60, 0, 10}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({1, 0, 10, 5, 20}), ErrorCode::kMalformed, "§4.6");
}

TEST(Tail, ComesBackAndHasOneSizeOnly) {
  const Buffer bytes = write_tail(1234567890123);
  ASSERT_TRUE(read_tail(bytes));
  EXPECT_EQ(*read_tail(bytes), 1234567890123u);
  expect_exact_length(bytes, read_tail);
  EXPECT_EQ(write_chunk(kTailChunk, false, bytes).size(), kTailBytes);
}

TEST(Tail, LocatesTheIndexOrSaysThatItCannot) {
  const Buffer tail = write_chunk(kTailChunk, false, write_tail(60));
  const Result<ByteRange> range = locate_index(tail, 1000);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->offset, 1000 - kTailBytes - 60);
  EXPECT_EQ(range->size, 60u);
  EXPECT_TRUE(locate_index(tail, kTailBytes + 60));
  expect_refused(locate_index(tail, kTailBytes + 59), ErrorCode::kMalformed, "§4.7");
  expect_refused(locate_index(tail, 0), ErrorCode::kMalformed, "§4.7");
  expect_refused(locate_index(Bytes(tail).first(kTailBytes - 1), 1000), ErrorCode::kMalformed, "§4.7");
  expect_refused(locate_index(write_chunk(kGopChunk, false, write_tail(60)), 1000), ErrorCode::kMalformed,
                 "§4.7");
  for (std::size_t i = 0; i < tail.size(); ++i) {
    Buffer changed = tail;
    changed[i] ^= 1;
    EXPECT_FALSE(locate_index(changed, 1000)) << i;
  }
}

TEST(Index, AWholeChunkIsParsedAndADamagedOneRefused) {
  const Buffer chunk = write_chunk(kIndexChunk, true, write_index(kEntries));
  const Result<std::vector<IndexEntry>> entries = parse_index(chunk);
  ASSERT_TRUE(entries);
  EXPECT_EQ(*entries, kEntries);
  for (std::size_t i = 0; i < chunk.size(); ++i) {
    Buffer changed = chunk;
    changed[i] ^= 0x10;
    EXPECT_FALSE(parse_index(changed)) << i;
    EXPECT_FALSE(parse_index(Bytes(chunk).first(i))) << i;
  }
}

}  // namespace
}  // namespace tvg
