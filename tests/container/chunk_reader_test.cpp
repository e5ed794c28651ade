#include "container/chunk_reader.hpp"

#include "container/head.hpp"
#include "container/metadata.hpp"
#include "container/packet.hpp"

#include <algorithm>
#include <array>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace tvg {
namespace {

using Buffer = std::vector<std::uint8_t>;
using Event = ChunkReader::Event;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr ChunkType kNote = {'n', 'o', 't', 'e'};

void append(Buffer& target, Bytes bytes) {
  target.insert(target.end(), bytes.begin(), bytes.end());
}

Buffer head_chunk() {
  StreamLimits limits{10, 10, 4, 1000, 2, 300, 0, 200, 3, 2};
  limits.decoder_memory = decoder_memory_with_plans(limits);
  return write_chunk(kHeadChunk, false, write_head(limits));
}

/// The reader looks at the counts of a mesh and no further.
Buffer mesh_payload(std::uint8_t which = 0) {
  return write_mesh({3, 1, false, Buffer{1, 2, which}, {}});
}

Buffer gop_chunk(std::uint32_t frames, std::uint64_t label = 0, std::uint8_t mesh = 0) {
  GopHeader header;
  header.mesh = checksum(mesh_payload(mesh));
  header.first_frame = label;
  header.frame_count = frames;
  header.packet_count = frames + 2;
  ByteWriter gop;
  const std::uint32_t header_checksum = write_packet(gop, 0, packet_kind::kHeader, write_gop_header(header));
  for (std::uint32_t k = 1; k <= frames; ++k) {
    write_packet(gop, packet_seed(header_checksum, k), packet_kind::frame(Predictor::kElp),
                 Buffer(k, static_cast<std::uint8_t>(k)));
  }
  write_packet(gop, packet_seed(header_checksum, frames + 1), 200, Buffer{1});
  write_packet(gop, packet_seed(header_checksum, frames + 2), packet_kind::kDigest, Buffer(9));
  return write_chunk(kGopChunk, false, gop.data());
}

Buffer data_payload() {
  return {1, 'x', 0, 2, '{', '}'};
}

Buffer plan_payload() {
  ByteWriter plan;
  plan.u32(checksum(mesh_payload()));
  plan.varint(0);
  plan.varint(9);
  plan.bytes(Buffer(100, 7));
  return plan.take();
}

Buffer chunk_of(ChunkKind kind) {
  switch (kind) {
    case ChunkKind::kHead:
      return head_chunk();
    case ChunkKind::kMetadata:
      return write_chunk(kMetadataChunk, true, write_metadata({{"fps", "30"}}));
    case ChunkKind::kData:
      return write_chunk(kDataChunk, true, data_payload());
    case ChunkKind::kMesh:
      return write_chunk(kMeshChunk, false, mesh_payload());
    case ChunkKind::kPlan:
      return write_chunk(kPlanChunk, false, plan_payload());
    case ChunkKind::kGop:
      return gop_chunk(2);
    case ChunkKind::kIndex:
      return write_chunk(kIndexChunk, true, write_index({}));
    case ChunkKind::kTail:
      return write_chunk(kTailChunk, false, write_tail(21));
    case ChunkKind::kAncillary:
      return write_chunk(kNote, true, Buffer{1, 2, 3});
    default:
      return write_chunk(kNote, false, Buffer{1, 2, 3});
  }
}

/// Everything that reading gives, to the end or to where it fails; messages of what is wrong.
struct Reading {
  std::vector<Event> events;
  std::vector<std::string> problems;
  std::string error;
  Buffer structures;  ///< the bytes of all structures given out
};

Reading read_all(Bytes stream, std::size_t piece) {
  ChunkReader reader{DecoderLimits()};
  Reading reading;
  for (;;) {
    const Event event = reader.next();
    if (event == Event::kNeedBytes) {
      const Bytes next = stream.first(std::min(piece, stream.size()));
      stream = stream.subspan(next.size());
      if (next.empty()) reader.finish();
      EXPECT_TRUE(reader.push(next));
      continue;
    }
    append(reading.structures, reader.raw());
    reading.events.push_back(event);
    if (event == Event::kProblem || event == Event::kGopLost)
      reading.problems.push_back(reader.problem().error.message);
    if (event == Event::kFailed) reading.error = reader.error().message;
    if (event == Event::kFailed || event == Event::kEnd) return reading;
  }
}

Buffer stream_of(const std::vector<ChunkKind>& kinds) {
  Buffer stream(kSignature.begin(), kSignature.end());
  for (const ChunkKind kind : kinds) append(stream, chunk_of(kind));
  return stream;
}

TEST(ChunkOrder, EveryPairOfStateAndChunkIsWhatTheTableSays) {
  using K = ChunkKind;
  const std::array<std::vector<K>, 5> states = {{{},
                                                 {K::kHead},
                                                 {K::kHead, K::kMesh},
                                                 {K::kHead, K::kMesh, K::kIndex},
                                                 {K::kHead, K::kIndex, K::kTail}}};
  // t: taken, m: malformed and passed over, i: malformed and taken, o: malformed by what it names, e: the end
  // of reading.
  const std::array<std::string, 5> table = {"teeeeeeeee", "mtttootite", "mttttttite", "mmmmmmmtte",
                                            "eeeeeeeeee"};
  for (std::size_t state = 0; state < states.size(); ++state) {
    for (std::size_t k = 0; k < kChunkKinds; ++k) {
      SCOPED_TRACE(testing::Message() << "state " << state << ", chunk " << k);
      const char expected = table[state][k];
      std::vector<K> kinds = states[state];
      const Reading before = read_all(stream_of(kinds), 1000);
      kinds.push_back(static_cast<K>(k));
      const Reading after = read_all(stream_of(kinds), 1000);
      // An index without the mesh does not match; it counts as taken.
      EXPECT_EQ(after.problems.size(), expected == 'm' || expected == 'i' || expected == 'o' ? 1u : 0u);
      const bool read_on = after.error.empty() || after.error == "the stream ends before it is complete";
      EXPECT_EQ(read_on, expected != 'e') << after.error;
      if (expected == 'm') {
        EXPECT_EQ(after.events.size(), before.events.size() + 2) << "the problem, and that a chunk begins";
      }
    }
  }
}

TEST(ChunkReader, AnyPiecesGiveTheSameStructuresAndAllBytesOfThem) {
  Buffer stream = stream_of({ChunkKind::kHead, ChunkKind::kMetadata, ChunkKind::kMesh, ChunkKind::kGop});
  Buffer all(stream.begin() + kSignature.size(), stream.end());
  const Reading whole = read_all(stream, stream.size());
  EXPECT_EQ(whole.structures, all) << "a chunk is the sum of its structures";
  EXPECT_THAT(whole.events,
              ElementsAre(Event::kChunk, Event::kHead, Event::kChunk, Event::kMetadata, Event::kChunk,
                          Event::kMesh, Event::kChunk, Event::kGop, Event::kFrame, Event::kFrame,
                          Event::kPacket, Event::kDigest, Event::kGopEnd, Event::kFailed));
  EXPECT_THAT(whole.error, HasSubstr("ends before"));
  for (const std::size_t piece : {1u, 2u, 3u, 7u, 30u}) {
    const Reading pieces = read_all(stream, piece);
    EXPECT_EQ(pieces.events, whole.events) << piece;
    EXPECT_EQ(pieces.structures, whole.structures) << piece;
  }
}

TEST(ChunkReader, APayloadAboveItsBoundIsNotWaitedFor) {
  const auto announced = [](ChunkType type, bool ancillary, std::uint32_t length) {
    ByteWriter header;
    for (const char letter : type) header.u8(static_cast<std::uint8_t>(letter));
    header.u32(ancillary ? 1 : 0);
    header.u32(length);
    header.u32(checksum(header.data()));
    return header.take();
  };
  // Meshes of 300 bytes are declared, and planes of 200.
  const struct {
    Buffer header;
    const char* message;
  } cases[] = {
      {announced(kMetadataChunk, true, kMaxMetadataPayload + 1), "too long"},
      {announced(kDataChunk, true, kMaxDataPayload + 1), "too long"},
      {announced(kMeshChunk, false, 301), "too long"},
      {announced(kIndexChunk, true, (1 << 20) + 1), "too long"},
      {announced(kMeshChunk, false, 300), ""},
      {announced(kIndexChunk, true, 1 << 20), ""},
      {announced(kPlanChunk, false, 201), "too long"},
      {announced(kPlanChunk, false, 200), ""},
      {announced(kGopChunk, false, kMaxChunkLength), ""},
  };
  for (const auto& [header, message] : cases) {
    Buffer stream = stream_of({ChunkKind::kHead});
    append(stream, header);
    ChunkReader reader{DecoderLimits()};
    ASSERT_TRUE(reader.push(stream));
    EXPECT_EQ(reader.next(), Event::kChunk);
    EXPECT_EQ(reader.next(), Event::kHead);
    if (*message == '\0') {
      EXPECT_EQ(reader.next(), Event::kChunk);
      continue;
    }
    ASSERT_EQ(reader.next(), Event::kProblem);
    EXPECT_THAT(reader.problem().error.message, HasSubstr(message));
  }
}

TEST(ChunkReader, AGopWhoseMeshIsGoneIsCountedAndPassedOver) {
  Buffer stream = stream_of({ChunkKind::kHead, ChunkKind::kGop, ChunkKind::kMesh, ChunkKind::kGop});
  const Reading reading = read_all(stream, 5);
  EXPECT_THAT(reading.events,
              ElementsAre(Event::kChunk, Event::kHead, Event::kChunk, Event::kGopLost, Event::kChunk,
                          Event::kMesh, Event::kChunk, Event::kGop, Event::kFrame, Event::kFrame,
                          Event::kPacket, Event::kDigest, Event::kGopEnd, Event::kFailed));
}

TEST(ChunkReader, TheLatestMeshesAreInForceAndOneThatComesAgainIsTheLatest) {
  const auto mesh = [](std::uint8_t which) { return write_chunk(kMeshChunk, false, mesh_payload(which)); };
  Buffer stream(kSignature.begin(), kSignature.end());
  for (const Buffer& chunk : {head_chunk(), mesh(1), mesh(2), gop_chunk(1, 0, 1), gop_chunk(1, 1, 2), mesh(1),
                              mesh(3), gop_chunk(1, 2, 1), gop_chunk(1, 3, 2), gop_chunk(1, 4, 3)})
    append(stream, chunk);
  const Reading reading = read_all(stream, 1000);
  EXPECT_EQ(std::count(reading.events.begin(), reading.events.end(), Event::kGop), 4);
  EXPECT_THAT(reading.problems, ElementsAre(HasSubstr("not in force"))) << "mesh 2, of the second-last GOP";
}

TEST(ChunkReader, GoesOnAtAnyChunk) {
  const Buffer start = stream_of({ChunkKind::kHead, ChunkKind::kMesh});
  ChunkReader reader{DecoderLimits()};
  ASSERT_TRUE(reader.push(start));
  while (reader.next() != Event::kNeedBytes) {
  }
  const std::array<std::uint64_t, 1> mesh = {start.size() - chunk_of(ChunkKind::kMesh).size()};
  reader.jump(1000000, mesh);
  ASSERT_TRUE(reader.push(gop_chunk(1)));
  EXPECT_EQ(reader.next(), Event::kChunk);
  EXPECT_EQ(reader.chunk_offset(), 1000000u);
  EXPECT_EQ(reader.next(), Event::kGop);
  EXPECT_EQ(reader.meshes().find(reader.gop().mesh)->offset, mesh[0]);
  reader.pass_over();
  EXPECT_EQ(reader.next(), Event::kNeedBytes);
  EXPECT_TRUE(reader.at_chunk());
}

}  // namespace
}  // namespace tvg
