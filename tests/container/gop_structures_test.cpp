#include "base/checksum.hpp"
#include "container/chunk.hpp"
#include "container/gop_header.hpp"
#include "container/index.hpp"
#include "container/packet.hpp"
#include "structures_toolbox.hpp"

#include <cstdint>
#include <functional>
#include <utility>

#include <tvg/stream_map.hpp>

// GOPs, and where they are.
namespace tvg {
namespace {

GopHeader some_gop() {
  GopHeader header;
  header.mesh = 0x12345678;
  header.first_frame = 12;
  header.frame_count = 50;
  header.packet_count = 51;
  return header;
}

TEST(GopHeaderPacket, ComesBackWithWhatTheModeAdds) {
  const Buffer planes = {1, 2, 3, 4, 5, 6, 7, 8}, fields = {8, 9};
  GopHeader header = some_gop();
  header.planes = planes;
  header.mode = 77;
  header.fields = fields;
  const Buffer bytes = write_gop_header(header);
  const Result<GopHeader> back = read_gop_header(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->mesh, 0x12345678u);
  EXPECT_EQ(back->first_frame, 12u);
  EXPECT_EQ(back->frame_count, 50u);
  EXPECT_EQ(back->packet_count, 51u);
  EXPECT_EQ(back->plane_count(), 2u);
  EXPECT_EQ(Buffer(back->planes.begin(), back->planes.end()), planes);
  EXPECT_EQ(back->mode, 77u);
  EXPECT_EQ(Buffer(back->fields.begin(), back->fields.end()), fields);
}

TEST(GopHeaderPacket, EveryFieldOutOfRangeIsRefused) {
  const Buffer many_planes(4 * 257);
  const std::vector<std::pair<const char*, std::function<void(GopHeader&)>>> faults = {
      {"no frames", [](GopHeader& h) { h.frame_count = 0; }},
      {"no packet for the digest", [](GopHeader& h) { h.packet_count = 50; }},
      {"packets", [](GopHeader& h) { h.packet_count = 0x80000000; }},
      {"first frame", [](GopHeader& h) { h.first_frame = (std::uint64_t{1} << 62) + 1; }},
      {"planes", [&](GopHeader& h) { h.planes = many_planes; }},
  };
  for (const auto& [name, fault] : faults) {
    SCOPED_TRACE(name);
    GopHeader header = some_gop();
    fault(header);
    expect_refused(read_gop_header(write_gop_header(header)), ErrorCode::kMalformed, "§4.5.1");
  }
  const Buffer good = write_gop_header(some_gop());
  for (std::size_t length = 0; length < good.size(); ++length)
    expect_refused(read_gop_header(Bytes(good).first(length)), ErrorCode::kMalformed, "§4.5.1");
}

TEST(Packet, ChecksumKnowsTheKindThePlaceAndTheGop) {
  const Buffer bytes = {1, 2, 3};
  const auto checksum_of = [&bytes](std::uint64_t seed, std::uint8_t kind) {
    ByteWriter gop;
    return write_packet(gop, seed, kind, bytes);
  };
  EXPECT_NE(checksum_of(packet_seed(7, 1), 32), checksum_of(packet_seed(7, 2), 32));
  EXPECT_NE(checksum_of(packet_seed(7, 1), 32), checksum_of(packet_seed(8, 1), 32));
  EXPECT_NE(checksum_of(packet_seed(7, 1), 32), checksum_of(packet_seed(7, 1), 33));
  ByteWriter gop;
  gop.u8(99);  // what stands before a packet is not covered
  const std::uint32_t sum = write_packet(gop, packet_seed(7, 1), 34, bytes);
  EXPECT_EQ(sum, checksum(Buffer{34, 3, 1, 2, 3}, packet_seed(7, 1)));
  const PacketRead packet = read_packet(Bytes(gop.data()).subspan(1), 9, packet_seed(7, 1), 3);
  ASSERT_EQ(packet.state, PacketRead::State::kWhole);
  EXPECT_EQ(packet.kind, 34);
  EXPECT_EQ(packet.checksum, sum);
  EXPECT_EQ(packet.total, 9u);
  EXPECT_EQ(Buffer(packet.content.begin(), packet.content.end()), bytes);
}

TEST(Packet, IsTakenForWhatItsFirstBytesSay) {
  using State = PacketRead::State;
  ByteWriter gop;
  write_packet(gop, 5, 0, Buffer(200, 1));
  const Bytes bytes = gop.data();
  const auto read = [](Bytes some, std::uint64_t left, std::uint32_t most) {
    return read_packet(some, left, 5, most).state;
  };
  for (std::size_t count = 0; count < bytes.size(); ++count)
    EXPECT_EQ(read(bytes.first(count), bytes.size(), 200), State::kIncomplete) << count;
  EXPECT_EQ(read(bytes, bytes.size(), 200), State::kWhole);
  EXPECT_EQ(read(bytes, bytes.size(), 199), State::kTooLarge);
  EXPECT_EQ(read(bytes, bytes.size() - 1, 200), State::kBeyond);
  EXPECT_EQ(read({}, 0, 200), State::kBeyond);
  EXPECT_EQ(read_packet(bytes, bytes.size(), 6, 200).state, State::kDamaged);
}

using Kind = IndexEntry::Kind;
const std::vector<IndexEntry> kEntries = {{100, 0, 0, Kind::kMesh},
                                          {400, 50, 1, Kind::kGop},
                                          {500, 0, 0, Kind::kMesh},
                                          {9000000000, 0xFFFFFFFF, 2, Kind::kGop}};

TEST(Index, ComesBack) {
  const Buffer bytes = write_index(kEntries);
  const Result<Index> back = read_index(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->entries, kEntries);
  IndexDigest digest;
  for (const IndexEntry& entry : kEntries) digest.add(entry);
  EXPECT_TRUE(back->digest == digest);
  digest.add(kEntries.back());
  EXPECT_FALSE(back->digest == digest);
  expect_exact_length(bytes, [](Bytes some) { return read_index(some); });
  EXPECT_TRUE(read_index(write_index({})));
}

TEST(Index, UndueCountsDistancesAndFieldsAreRefused) {
  const auto read = [](const std::vector<std::uint64_t>& varints) {
    ByteWriter writer;
    for (const std::uint64_t value : varints) writer.varint(value);
    return read_index(writer.data());
  };
  EXPECT_TRUE(read({2, 1, 10, 0, 3, 20, 3, 5, 1, 0}));
  EXPECT_TRUE(read({3, 1, 10, 0, 2, 9, 0, 4, 20, 4, 5, 1, 1, 1})) << "planes one back";
  EXPECT_EQ(read({2, 1, 10, 0, 9, 20, 3, 5, 1, 0})->entries.size(), 1u) << "other kinds are skipped";
  expect_refused(read({2, 1, 10, 0, 3, 0, 3, 5, 1, 0}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({2, 1, 10, 0, 3, 20, 3, 0, 1, 0}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({2, 1, 10, 0, 3, 20, 7, 0x100000000, 1, 0}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({2, 1, 10, 0, 3, 20, 3, 5, 2, 0}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({2, 1, 10, 0, 3, 20, 3, 5, 0, 0}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({2, 1, 10, 0, 3, 20, 4, 5, 1, 1, 1}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({2, 1, 10, 0, 3, 20, 4, 5, 1, 0, 0}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({1, 1, 10, 1, 0}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({1, 1, (std::uint64_t{1} << 62) + 1, 0}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({2, 1, std::uint64_t{1} << 62, 0, 1, 1, 0}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({std::uint64_t{1} << 60, 1, 10, 0}), ErrorCode::kMalformed, "§4.6");
  expect_refused(read({1, 1, 10, 0, 1, 20, 0}), ErrorCode::kMalformed, "§4.6");
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
