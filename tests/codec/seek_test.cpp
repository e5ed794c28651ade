#include "codec_toolbox.hpp"
#include "corpus/corpus.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include <tvg/join.hpp>

namespace tvg::test {
namespace {

Stream corpus_stream(const char* name) {
  EncodeOptions options;
  options.fine_bits = 12;
  options.coarse_bits = 9;
  options.gop_frames = 5;
  return encode_sequence(corpus::find_corpus_entry(name)->make(*corpus::named_size("small")).sequence,
                         options);
}

/// Two meshes, 12 frames of each, in GOPs of 5, 5, 2.
Stream stream_of_two_meshes() {
  std::vector<Stream> parts = {corpus_stream("toy"), corpus_stream("cloth")};
  std::vector<JoinInput> inputs;
  for (Stream& part : parts) {
    inputs.push_back({"part", [&part](std::span<std::uint8_t> bytes) -> Result<std::size_t> {
                        const std::size_t count = std::min(bytes.size(), part.size());
                        std::copy_n(part.begin(), count, bytes.begin());
                        part.erase(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(count));
                        return count;
                      }});
  }
  Stream joined;
  const Result<JoinReport> report =
      join(std::move(inputs), {}, [&joined](std::span<const std::uint8_t> bytes) {
        joined.insert(joined.end(), bytes.begin(), bytes.end());
        return Status();
      });
  EXPECT_TRUE(report && report->meshes == 2 && report->frames == 24);
  return joined;
}

std::vector<IndexEntry> index_of(const Stream& stream) {
  const Result<ByteRange> range = locate_index(std::span(stream).last(kTailBytes), stream.size());
  EXPECT_TRUE(range);
  const Result<std::vector<IndexEntry>> index = parse_index(std::span(stream).subspan(
      static_cast<std::size_t>(range->offset), static_cast<std::size_t>(range->size)));
  EXPECT_TRUE(index);
  return index ? *index : std::vector<IndexEntry>();
}

/// Reads a stream as a player with a file does: from any offset, in small pieces.
class Reader {
 public:
  explicit Reader(const Stream& stream, bool hops = true) : stream_(stream), hops_(hops) {
    while (poll() != Decoder::Event::kHead) {
    }
  }

  Decoder::Event poll() {
    for (;;) {
      const Decoder::Event event = decoder.poll();
      if (event == Decoder::Event::kDamage) damage.push_back(decoder.damage());
      if (event != Decoder::Event::kNeedBytes) return event;
      if (hops_) at_ += static_cast<std::size_t>(decoder.skip());
      if (at_ >= stream_.size()) {
        decoder.finish();
        continue;
      }
      const std::size_t count = std::min<std::size_t>(64, stream_.size() - at_);
      decoder.push(std::span(stream_).subspan(at_, count));
      at_ += count;
      bytes_read += count;
    }
  }

  /// The frame that comes next after seeking; nothing where the stream ends first.
  std::optional<DecodedFrame> frame_at(std::uint64_t frame) {
    const Result<std::uint64_t> offset = decoder.seek(frame);
    EXPECT_TRUE(offset);
    at_ = static_cast<std::size_t>(*offset);
    return next_frame();
  }

  std::optional<DecodedFrame> next_frame() {
    for (;;) {
      const Decoder::Event event = poll();
      if (event == Decoder::Event::kFrame) return current_frame(decoder);
      if (event == Decoder::Event::kEnd || event == Decoder::Event::kError) return std::nullopt;
    }
  }

  Decoder decoder;
  std::vector<Damage> damage;
  std::size_t bytes_read = 0;

 private:
  const Stream& stream_;
  bool hops_;
  std::size_t at_ = 0;
};

void expect_frame(const std::optional<DecodedFrame>& frame, const DecodedStream& whole,
                  std::uint64_t number) {
  ASSERT_TRUE(frame.has_value()) << number;
  ASSERT_EQ(frame->number, number);
  ASSERT_EQ(frame->positions, whole.frames[number].positions) << number;
  ASSERT_EQ(frame->flags, whole.frames[number].flags) << number;
}

TEST(Seek, GivesTheFrameAskedForInAnyOrder) {
  const Stream stream = stream_of_two_meshes();
  const DecodedStream whole = decode_stream(stream);
  ASSERT_EQ(whole.frames.size(), 24u);
  EXPECT_EQ(whole.index, index_of(stream));
  for (const bool with_index : {true, false}) {
    for (const bool hops : {true, false}) {
      Reader reader(stream, hops);
      if (with_index) reader.decoder.set_index(index_of(stream));
      std::mt19937 random(7);
      for (int i = 0; i < 60; ++i) {
        const std::uint64_t wanted = random() % 24;
        ASSERT_NO_FATAL_FAILURE(expect_frame(reader.frame_at(wanted), whole, wanted))
            << (with_index ? "index" : "no index") << (hops ? ", hops" : ", reads on");
        if (wanted < 23) {
          ASSERT_NO_FATAL_FAILURE(expect_frame(reader.next_frame(), whole, wanted + 1)) << "the next one";
        }
      }
      EXPECT_TRUE(reader.damage.empty());
    }
  }
}

TEST(Seek, WithAnIndexReadsTheMeshAndTheGopOnly) {
  const Stream stream = stream_of_two_meshes();
  const std::vector<IndexEntry> index = index_of(stream);
  Reader reader(stream);
  reader.decoder.set_index(index);
  const std::size_t before = reader.bytes_read;
  ASSERT_TRUE(reader.frame_at(22));
  const std::uint64_t mesh_bytes = index[5].offset - index[4].offset;
  const std::uint64_t gop_bytes = stream.size() - index[7].offset;
  EXPECT_LE(reader.bytes_read - before, mesh_bytes + gop_bytes + 2 * 64);
  const std::size_t there = reader.bytes_read;
  ASSERT_TRUE(reader.frame_at(17));
  EXPECT_LE(reader.bytes_read - there, index[7].offset - index[6].offset + 64)
      << "the mesh is in force already";
}

TEST(Seek, ForwardInTheSameGopReadsNothingAgain) {
  const Stream stream = corpus_stream("toy");
  Reader reader(stream);
  ASSERT_TRUE(reader.frame_at(0));
  ASSERT_TRUE(reader.frame_at(3));
  ASSERT_EQ(reader.frame_at(4)->number, 4u);
  EXPECT_LE(reader.bytes_read, index_of(stream)[2].offset + 64);
}

TEST(Seek, BeforeTheHeadIsRefused) {
  Decoder decoder;
  const Result<std::uint64_t> offset = decoder.seek(0);
  ASSERT_FALSE(offset);
  EXPECT_EQ(offset.error().code, ErrorCode::kInvalidArgument);
}

TEST(Seek, BehindTheEndIsRefusedByTheIndexAndElseRunsToTheEnd) {
  const Stream stream = corpus_stream("toy");
  Reader reader(stream);
  EXPECT_FALSE(reader.frame_at(12));
  EXPECT_TRUE(reader.frame_at(11)) << "and back";
  reader.decoder.set_index(index_of(stream));
  const Result<std::uint64_t> offset = reader.decoder.seek(12);
  ASSERT_FALSE(offset);
  EXPECT_NE(offset.error().message.find("12"), std::string::npos);
}

TEST(Seek, WorksAfterTheEndAndAfterACut) {
  const Stream whole_stream = corpus_stream("toy");
  const DecodedStream whole = decode_stream(whole_stream);
  const Stream cut(whole_stream.begin(), whole_stream.begin() + static_cast<std::ptrdiff_t>(
                                                                    index_of(whole_stream)[3].offset + 100));
  for (const Stream& stream : {whole_stream, cut}) {
    Reader reader(stream);
    while (reader.next_frame()) {
    }
    for (const std::uint64_t wanted : {7u, 0u, 9u}) {
      ASSERT_NO_FATAL_FAILURE(expect_frame(reader.frame_at(wanted), whole, wanted));
    }
  }
}

TEST(Seek, IntoADamagedGopReportsItAndGoesOnBehind) {
  Stream stream = corpus_stream("toy");
  const DecodedStream whole = decode_stream(stream);
  const std::vector<IndexEntry> index = index_of(stream);
  stream[static_cast<std::size_t>(index[2].offset) + 20] ^= 1;  // in the header of the second GOP
  for (const bool with_index : {true, false}) {
    Reader reader(stream);
    if (with_index) reader.decoder.set_index(index);
    ASSERT_NO_FATAL_FAILURE(expect_frame(reader.frame_at(7), whole, 10));
    ASSERT_FALSE(reader.damage.empty());
    EXPECT_EQ(reader.damage.back().first_frame, 5u);
    EXPECT_EQ(reader.damage.back().frame_count, 5u);
  }
}

TEST(Seek, ByAnIndexOfAnotherStreamIsReportedAndNamesNoWrongFrame) {
  const Stream stream = corpus_stream("toy");
  std::vector<IndexEntry> index = index_of(stream);
  index[1].frame_count = 4;
  Reader reader(stream);
  reader.decoder.set_index(index);
  reader.frame_at(2);
  ASSERT_FALSE(reader.damage.empty());
  EXPECT_EQ(reader.damage.front().error.code, ErrorCode::kMalformed);
  EXPECT_NE(reader.damage.front().error.message.find("index"), std::string::npos);
}

}  // namespace
}  // namespace tvg::test
