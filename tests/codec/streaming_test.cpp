#include "codec_toolbox.hpp"
#include "container/chunk.hpp"
#include "container/head.hpp"
#include "container/stream_writer.hpp"
#include "corpus/corpus.hpp"

#include <cstring>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

namespace tvg::test {
namespace {

Sequence small_sequence(std::string_view name = "toy") {
  return corpus::find_corpus_entry(name)->make(*corpus::named_size("small")).sequence;
}

EncodeOptions hybrid_options() {
  EncodeOptions options;
  options.fine_bits = 12;
  options.coarse_bits = 9;
  options.gop_frames = 5;
  return options;
}

TEST(Streaming, EveryNumberOfThreadsGivesTheSameBytes) {
  const Sequence sequence = small_sequence();
  EncodeOptions options = hybrid_options();
  options.gop_frames = 2;
  const Stream one = encode_sequence(sequence, options);
  for (const unsigned threads : {0u, 2u, 5u, 100u}) {
    options.threads = threads;
    EXPECT_EQ(encode_sequence(sequence, options), one) << threads;
  }
}

TEST(Streaming, AnySplitOfTheBytesGivesTheSameFrames) {
  const Stream stream = encode_sequence(small_sequence(), hybrid_options());
  const DecodedStream whole = decode_stream(stream);
  ASSERT_TRUE(whole.complete);
  ASSERT_EQ(whole.frames.size(), 12u);
  std::mt19937 random(1);
  const std::vector<std::function<std::size_t()>> sizes = {
      [] { return std::size_t{1}; }, [] { return std::size_t{4096}; }, [&] { return random() % 50; },
      [&] { return random() % 3000; }};
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const DecodedStream pieces = decode_pieces(stream, sizes[i]);
    ASSERT_TRUE(pieces.complete) << i;
    ASSERT_TRUE(pieces.damage.empty()) << i;
    EXPECT_EQ(pieces.meshes, whole.meshes);
    EXPECT_EQ(pieces.index, whole.index);
    ASSERT_NO_FATAL_FAILURE(expect_same_frames(pieces, whole)) << i;
  }
}

TEST(Streaming, AFrameComesOutOnceItsLastByteIsIn) {
  const Stream stream = encode_sequence(small_sequence(), hybrid_options());
  Decoder decoder;
  DecodedStream result;
  std::size_t in_gop = 0;
  std::uint64_t gop_bytes = 0, frame_bytes = 0;
  for (const std::uint8_t& byte : stream) {
    decoder.push({&byte, 1});
    if (gop_bytes > 0) ++in_gop;
    for (Decoder::Event event = decoder.poll(); event != Decoder::Event::kNeedBytes; event = decoder.poll()) {
      ASSERT_NE(event, Decoder::Event::kError);
      if (event == Decoder::Event::kGop) in_gop = 0, gop_bytes = decoder.gop().bytes, frame_bytes = 0;
      if (event == Decoder::Event::kFrame) {
        frame_bytes += decoder.frame_bytes();
        ASSERT_EQ(in_gop, frame_bytes) << "frame " << decoder.frame_number();
      }
    }
  }
}

/// A source that can be read only once, as a pipe.
class OnceSource final : public SourceDecorator {
 public:
  explicit OnceSource(const Sequence& sequence)
      : SourceDecorator(std::make_unique<SequenceSource>(sequence)) {}

  std::optional<std::uint64_t> frame_count() const override { return {}; }
  bool rewind() override { return false; }
};

TEST(Streaming, ASourceReadOnceGivesEachGopItsOwnBox) {
  const Sequence sequence = small_sequence("cloth");
  EncodeOptions options = hybrid_options();
  Stream stream;
  OnceSource source(sequence);
  const Result<EncodeReport> report = encode(source, options, [&](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  });
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->box_of_each_gop);
  EXPECT_EQ(report->gops, 3u);
  const DecodedStream back = decode_stream(stream);
  ASSERT_TRUE(back.complete);
  ASSERT_EQ(back.frames.size(), sequence.frames.size());
  EXPECT_NE(back.frames[0].gop.step, back.frames[5].gop.step);
  for (const DecodedFrame& frame : back.frames) {
    for (std::size_t i = 0; i < frame.positions.size(); ++i) {
      const double half = std::ldexp(frame.gop.step, frame.flags[i / 3] != 0 ? 0 : 3) / 2;
      ASSERT_NEAR(frame.positions[i], sequence.frames[frame.number][i], half * 1.000001 + 1e-6);
    }
  }
}

TEST(Streaming, MetadataOfSourceAndCallerComesBack) {
  Sequence sequence = small_sequence();
  sequence.metadata = {{"fps", "25"}, {"name", "Spielzeug ⚙"}};
  EncodeOptions options;
  options.metadata = {{"fps", "30000/1001"}, {"заметка", "日本語"}, {"empty", ""}};
  const DecodedStream back = decode_stream(encode_sequence(sequence, options));
  const Metadata expected = {
      {"fps", "30000/1001"}, {"name", "Spielzeug ⚙"}, {"заметка", "日本語"}, {"empty", ""}};
  EXPECT_EQ(back.metadata, expected) << "the caller's own wins";
}

TEST(Streaming, PositionsGoIntoACallersBufferWithAStride) {
  const Stream stream = encode_sequence(small_sequence(), hybrid_options());
  Decoder decoder;
  decoder.push(stream);
  while (decoder.poll() != Decoder::Event::kFrame) {
  }
  const DecodedFrame frame = current_frame(decoder);
  const std::size_t count = decoder.mesh().vertex_count;
  for (const std::size_t stride : {12u, 16u, 20u, 13u, 64u}) {
    std::vector<std::uint8_t> buffer(count * stride, 0xAB);
    decoder.copy_positions(buffer.data(), stride);
    for (std::size_t v = 0; v < count; ++v) {
      ASSERT_EQ(std::memcmp(buffer.data() + v * stride, frame.positions.data() + 3 * v, 12), 0);
      for (std::size_t i = 12; i < stride; ++i) ASSERT_EQ(buffer[v * stride + i], 0xAB) << "between vertices";
    }
  }
}

/// The chunks of a stream: type and bytes.
std::vector<std::pair<ChunkType, Bytes>> chunks_of(const Stream& stream) {
  std::vector<std::pair<ChunkType, Bytes>> chunks;
  for (std::size_t at = kSignature.size(); at < stream.size();) {
    const std::optional<ChunkHeader> header = read_chunk_header(Bytes(stream).subspan(at));
    if (!header) break;
    const auto size = static_cast<std::size_t>(header->total_size());
    chunks.emplace_back(header->type, Bytes(stream).subspan(at, size));
    at += size;
  }
  return chunks;
}

/// One stream of the meshes and GOPs of several.
Stream concatenated(const std::vector<Stream>& streams) {
  Stream result;
  StreamWriter writer([&result](Bytes bytes) {
    result.insert(result.end(), bytes.begin(), bytes.end());
    return Status();
  });
  StreamLimits limits;
  for (const Stream& stream : streams) limits = larger_limits(limits, decode_stream(stream).head.limits);
  EXPECT_TRUE(writer.write_start(limits, {}).ok());
  for (const Stream& stream : streams) {
    for (const auto& [type, bytes] : chunks_of(stream)) {
      if (type == kMeshChunk) {
        EXPECT_TRUE(writer.write_mesh_chunk(bytes).ok());
      }
      if (type == kGopChunk) {
        EXPECT_TRUE(writer.write_gop_chunk(bytes, 6).ok());
      }
    }
  }
  EXPECT_TRUE(writer.write_end().ok());
  return result;
}

TEST(Streaming, TwoMeshesInOneStreamAreDecodedOneAfterTheOther) {
  EncodeOptions options = hybrid_options();
  options.gop_frames = 6;
  const Stream toy = encode_sequence(small_sequence("toy"), options);
  const Stream soup = encode_sequence(small_sequence("soup"), options);
  const DecodedStream alone_toy = decode_stream(toy), alone_soup = decode_stream(soup);
  const DecodedStream both = decode_stream(concatenated({toy, soup}));
  ASSERT_TRUE(both.complete) << both.error.describe();
  ASSERT_TRUE(both.damage.empty()) << both.damage.front().error.describe();
  ASSERT_EQ(both.meshes.size(), 2u);
  EXPECT_EQ(both.meshes[0], alone_toy.meshes[0]);
  EXPECT_EQ(both.meshes[1], alone_soup.meshes[0]);
  ASSERT_EQ(both.frames.size(), 24u);
  for (std::size_t f = 0; f < 24; ++f) {
    const DecodedFrame& alone = f < 12 ? alone_toy.frames[f] : alone_soup.frames[f - 12];
    ASSERT_EQ(both.frames[f].number, f);
    ASSERT_EQ(both.frames[f].positions, alone.positions) << "frame " << f;
  }
}

TEST(Streaming, MeasuredBitsAddUpToThePacketsAndChangeNothing) {
  const Stream stream = encode_sequence(small_sequence(), hybrid_options());
  const DecodedStream plain = decode_stream(stream);
  Decoder decoder;
  decoder.measure_bits(true);
  decoder.push(stream);
  decoder.finish();
  std::size_t frames = 0;
  for (Decoder::Event event = decoder.poll(); event != Decoder::Event::kEnd; event = decoder.poll()) {
    ASSERT_NE(event, Decoder::Event::kError);
    if (event != Decoder::Event::kFrame) continue;
    const auto [x, y, z] = decoder.frame_bits();
    ASSERT_GE(std::min({x, y, z}), 0);
    // Around the residuals: the packet's kind, size, its checksum and at most a byte to end the arithmetic
    // code.
    ASSERT_NEAR(x + y + z, 8.0 * static_cast<double>(decoder.frame_bytes()), 8 * 18);
    ASSERT_EQ(current_frame(decoder).positions, plain.frames[frames++].positions);
  }
  EXPECT_EQ(frames, plain.frames.size());
}

}  // namespace
}  // namespace tvg::test
