#include "base/checksum.hpp"
#include "container/chunk.hpp"
#include "container/index.hpp"
#include "container/metadata.hpp"
#include "tests/codec/codec_toolbox.hpp"
#include "tests/conformance/streams.hpp"

#include <gmock/gmock.h>

#include <tvg/join.hpp>
#include <tvg/relay.hpp>

// Streams that break a rule of structure and whose frames are right all the same: the decoder says so, and
// who passes streams on refuses them.
namespace tvg::test {
namespace {

using ::testing::HasSubstr;

const Stream& gops() {
  static const Stream stream = conformance::make_stream("gops");
  return stream;
}

constexpr ChunkType kNote = {'n', 'o', 't', 'e'};

/// The chunks of the stream "gops" (HEAD, MESH, four GOPs of 2, 2, 2 and 1 frames, INDX, TAIL).
std::vector<Stream> chunks_of(const Stream& stream) {
  std::vector<Stream> chunks;
  for (std::size_t at = kSignature.size(); at < stream.size();) {
    const auto size = static_cast<std::size_t>(read_chunk_header(Bytes(stream).subspan(at))->total_size());
    const auto begin = stream.begin() + static_cast<std::ptrdiff_t>(at);
    chunks.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(size));
    at += size;
  }
  return chunks;
}

Stream stream_of(const std::vector<Stream>& chunks) {
  Stream stream(kSignature.begin(), kSignature.end());
  for (const Stream& chunk : chunks) stream.insert(stream.end(), chunk.begin(), chunk.end());
  return stream;
}

ChunkType type_of(const Stream& chunk) {
  return read_chunk_header(chunk)->type;
}

Bytes payload_of(const Stream& chunk) {
  return Bytes(chunk).subspan(kChunkHeaderSize, chunk.size() - kLeastChunkSize);
}

Stream flagged_otherwise(const Stream& chunk) {
  return write_chunk(type_of(chunk), !read_chunk_header(chunk)->ancillary, payload_of(chunk));
}

/// An index and the tail that leads to it.
void set_index(std::vector<Stream>& chunks, Bytes payload) {
  const Stream index = write_chunk(kIndexChunk, true, payload);
  chunks[6] = index;
  chunks[7] = write_chunk(kTailChunk, false, write_tail(index.size()));
}

Stream absurd_index(std::uint64_t count, std::size_t fill = 0) {
  ByteWriter payload;
  payload.varint(count);
  payload.bytes(Stream(fill, 0x55));
  return payload.take();
}

struct Malformed {
  const char* what;
  const char* message;  ///< of the first finding, a part of it
  std::uint64_t lost;   ///< frames, of 7
  std::function<void(std::vector<Stream>&)> change;
};

std::vector<Malformed> malformed_streams() {
  const Stream metadata = write_chunk(kMetadataChunk, true, write_metadata({{"fps", "30"}}));
  const auto put = [](std::vector<Stream>& chunks, std::size_t at, const Stream& chunk) {
    chunks.insert(chunks.begin() + static_cast<std::ptrdiff_t>(at), chunk);
  };
  const auto index_of = [](const std::vector<Stream>& chunks) {
    return read_index(payload_of(chunks[6]))->entries;
  };
  return {
      {"an index that counts a million", "more index entries", 0,
       [](auto& chunks) { set_index(chunks, absurd_index(1000000)); }},
      {"an index that counts 2^31", "more index entries", 0,
       [](auto& chunks) { set_index(chunks, absurd_index(std::uint64_t{1} << 31)); }},
      {"an index that counts 2^63", "more index entries", 0,
       [](auto& chunks) { set_index(chunks, absurd_index(std::uint64_t{1} << 63)); }},
      {"an index of 17 MiB", "too long", 0,
       [](auto& chunks) { set_index(chunks, absurd_index(1000000, std::size_t{17} << 20)); }},
      {"an index with another mesh", "a GOP's index entry is out of range", 0,
       [=](auto& chunks) {
         auto entries = index_of(chunks);
         ++entries[2].meshes_back;
         set_index(chunks, write_index(entries));
       }},
      {"an index of garbage", "index", 0, [](auto& chunks) { set_index(chunks, Stream(40, 0x55)); }},
      {"an index without the last GOP", "the index does not match", 0,
       [=](auto& chunks) {
         auto entries = index_of(chunks);
         entries.pop_back();
         set_index(chunks, write_index(entries));
       }},
      {"an index with other places", "the index does not match", 0,
       [=](auto& chunks) {
         auto entries = index_of(chunks);
         ++entries[2].offset;
         set_index(chunks, write_index(entries));
       }},
      {"an index that points behind itself", "behind the index", 0,
       [=](auto& chunks) {
         auto entries = index_of(chunks);
         entries.back().offset = 1u << 20;
         set_index(chunks, write_index(entries));
       }},
      {"a second index", "second index", 0, [=](auto& chunks) { put(chunks, 7, chunks[6]); }},
      {"an index flagged critical", "flag", 0,
       [=](auto& chunks) { chunks[6] = flagged_otherwise(chunks[6]); }},
      {"no index", "without an index", 0, [](auto& chunks) { chunks.erase(chunks.begin() + 6); }},
      {"a GOP behind the index", "a GOP follows the index", 0,
       [=](auto& chunks) { put(chunks, 7, chunks[5]); }},
      {"a mesh behind the index", "a mesh follows the index", 0,
       [=](auto& chunks) { put(chunks, 7, chunks[1]); }},
      {"metadata behind the index", "metadata follow the index", 0,
       [=](auto& chunks) { put(chunks, 7, metadata); }},
      {"a head behind the index", "second head", 0, [=](auto& chunks) { put(chunks, 7, chunks[0]); }},
      {"a second head", "second head", 0, [=](auto& chunks) { put(chunks, 3, chunks[0]); }},
      {"metadata flagged critical", "flag", 0,
       [=](auto& chunks) { put(chunks, 1, flagged_otherwise(metadata)); }},
      {"metadata with keys out of order", "ascending", 0,
       [=](auto& chunks) {
         put(chunks, 1, write_chunk(kMetadataChunk, true, Stream{2, 1, 'b', 0, 1, 'a', 0}));
       }},
      {"metadata of more than 1 MiB", "too long", 0,
       [=](auto& chunks) { put(chunks, 1, write_chunk(kMetadataChunk, true, Stream((1u << 20) + 1, 0))); }},
      {"a note that is damaged", "'note' is damaged", 0,
       [=](auto& chunks) {
         Stream note = write_chunk(kNote, true, Stream(100, 7));
         note[50] ^= 1;
         put(chunks, 3, note);
       }},
      {"a GOP's checksum that is damaged", "the checksum of a GOP", 0,
       [](auto& chunks) { chunks[3].back() ^= 1; }},
      {"a GOP with a byte behind its digest", "bytes follow the packets of a GOP", 0,
       [](auto& chunks) {
         const Bytes payload = payload_of(chunks[3]);
         Stream longer(payload.begin(), payload.end());
         longer.push_back(0);
         chunks[3] = write_chunk(kGopChunk, false, longer);
       }},
      {"a tail that leads elsewhere", "does not lead to the index", 0,
       [](auto& chunks) { chunks[7] = write_chunk(kTailChunk, false, write_tail(chunks[6].size() + 1)); }},
      {"a tail that is too short", "the tail has a wrong size", 0,
       [](auto& chunks) { chunks[7] = write_chunk(kTailChunk, false, Stream(7)); }},
      {"a GOP flagged ancillary", "flag", 2, [=](auto& chunks) { chunks[3] = flagged_otherwise(chunks[3]); }},
      {"a mesh flagged ancillary", "flag", 7,
       [=](auto& chunks) { chunks[1] = flagged_otherwise(chunks[1]); }},
      {"a GOP before the mesh", "the mesh of a GOP is not in force", 2,
       [=](auto& chunks) { std::swap(chunks[1], chunks[2]); }},
  };
}

Stream changed(const Malformed& entry) {
  std::vector<Stream> chunks = chunks_of(gops());
  EXPECT_EQ(chunks.size(), 8u);
  entry.change(chunks);
  return stream_of(chunks);
}

TEST(MalformedStreams, TheDecoderSaysWhatIsWrongAndLosesNoOtherFrame) {
  const DecodedStream right = decode_stream(gops());
  ASSERT_EQ(right.frames.size(), 7u);
  for (const Malformed& entry : malformed_streams()) {
    SCOPED_TRACE(entry.what);
    const Stream stream = changed(entry);
    for (const std::size_t piece : {std::size_t{1}, std::size_t{61}, stream.size()}) {
      if (piece < 100 && stream.size() > (1u << 20)) continue;
      const DecodedStream back = decode_pieces(stream, [piece] { return piece; });
      EXPECT_TRUE(back.complete) << back.error.describe();
      ASSERT_FALSE(back.damage.empty());
      EXPECT_THAT(back.damage.front().error.message, HasSubstr(entry.message));
      EXPECT_TRUE(back.damage.front().error.code == ErrorCode::kMalformed ||
                  back.damage.front().error.code == ErrorCode::kChecksumMismatch);
      std::uint64_t lost = 0;
      for (const Damage& damage : back.damage) {
        lost += damage.frame_count;
        EXPECT_TRUE(damage.count_known);
      }
      EXPECT_EQ(lost, entry.lost);
      ASSERT_EQ(back.frames.size(), 7u - entry.lost);
      for (const DecodedFrame& frame : back.frames) {
        ASSERT_LT(frame.number, 7u);
        EXPECT_EQ(frame.positions, right.frames[frame.number].positions);
      }
    }
  }
}

Status try_join(const Stream& stream, Stream& joined) {
  std::size_t at = 0;
  JoinInput input{"it", [&stream, &at](std::span<std::uint8_t> bytes) -> Result<std::size_t> {
                    const std::size_t count = std::min(bytes.size(), stream.size() - at);
                    std::copy_n(stream.begin() + static_cast<std::ptrdiff_t>(at), count, bytes.begin());
                    at += count;
                    return count;
                  }};
  std::vector<JoinInput> inputs;
  inputs.push_back(std::move(input));
  const Result<JoinReport> report = join(std::move(inputs), {}, [&joined](Bytes bytes) {
    joined.insert(joined.end(), bytes.begin(), bytes.end());
    return Status();
  });
  return report ? Status() : Status(report.error());
}

TEST(MalformedStreams, JoinRefusesThem) {
  Stream same;
  ASSERT_TRUE(try_join(gops(), same).ok());
  EXPECT_EQ(same, gops());
  for (const Malformed& entry : malformed_streams()) {
    Stream joined;
    const Status status = try_join(changed(entry), joined);
    ASSERT_FALSE(status.ok()) << entry.what;
    EXPECT_THAT(status.error().message, HasSubstr(entry.message)) << entry.what;
    EXPECT_TRUE(status.error().byte_offset) << entry.what;
  }
}

TEST(MalformedStreams, TheRelaySplitterRefusesThem) {
  for (const Malformed& entry : malformed_streams()) {
    SCOPED_TRACE(entry.what);
    StreamSplitter splitter;
    ASSERT_TRUE(splitter.push(changed(entry)).ok());
    std::optional<Error> error;
    for (std::size_t parts = 0; !error; ++parts) {
      ASSERT_LT(parts, 20u);
      Result<std::optional<StreamPart>> part = splitter.next();
      if (!part)
        error = part.error();
      else if (!*part)
        break;
    }
    ASSERT_TRUE(error);
    EXPECT_THAT(error->message, HasSubstr(entry.message));
    EXPECT_TRUE(error->byte_offset);
  }
}

TEST(MalformedStreams, WhatIsLostBeforeAnIndexThatSaysNothingIsSaidToBeUnknown) {
  std::vector<Stream> chunks = chunks_of(gops());
  chunks[5][4] ^= 1;  // the header of the last GOP
  set_index(chunks, absurd_index(std::uint64_t{1} << 31));
  const DecodedStream back = decode_stream(stream_of(chunks));
  EXPECT_TRUE(back.complete);
  EXPECT_EQ(back.frames.size(), 6u);
  ASSERT_EQ(back.damage.size(), 2u);
  EXPECT_THAT(back.damage[0].error.message, HasSubstr("more index entries"));
  EXPECT_TRUE(back.damage[0].count_known);
  EXPECT_THAT(back.damage[1].error.message, HasSubstr("a chunk header is damaged"));
  EXPECT_FALSE(back.damage[1].count_known);
}

TEST(MalformedStreams, WhatIsLostBeforeAGoodIndexIsCounted) {
  std::vector<Stream> chunks = chunks_of(gops());
  chunks[5][4] ^= 1;
  const DecodedStream back = decode_stream(stream_of(chunks));
  ASSERT_EQ(back.damage.size(), 1u);
  EXPECT_TRUE(back.damage[0].count_known);
  EXPECT_EQ(back.damage[0].first_frame, 6u);
  EXPECT_EQ(back.damage[0].frame_count, 1u);
}

}  // namespace
}  // namespace tvg::test
