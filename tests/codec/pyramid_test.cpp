#include "codec_toolbox.hpp"
#include "container/chunk.hpp"
#include "container/head.hpp"
#include "corpus/corpus.hpp"
#include "tests/connectivity/mesh_builders.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include <tvg/encoder.hpp>

// Frames that are predicted along the pyramid.
namespace tvg::test {
namespace {

Sequence corpus_sequence(const char* name, std::uint32_t frames) {
  return corpus::find_corpus_entry(name)->make({600, frames}).sequence;
}

EncodeOptions options_with(Predictor predictor) {
  EncodeOptions options;
  options.fine_bits = options.coarse_bits = 11;
  options.predictor = predictor;
  options.gop_frames = 8;
  return options;
}

TEST(PyramidMode, GivesTheFramesOfElpInFewerBytesOnSurfacesThatMove) {
  for (const char* name : {"cloth", "hand", "face"}) {
    const Sequence sequence = corpus_sequence(name, 24);
    const Stream by_elp = encode_sequence(sequence, options_with(Predictor::kElp));
    const Stream by_pyramid = encode_sequence(sequence, options_with(Predictor::kPyramid));
    EXPECT_LT(by_pyramid.size(), by_elp.size()) << name;
    expect_same_frames(decode_stream(by_pyramid), decode_stream(by_elp));
  }
}

TEST(PyramidMode, AutoIsHardlyLargerThanTheSmallerOfTheTwo) {
  for (const char* name : {"cloth", "toy", "soup"}) {
    const Sequence sequence = corpus_sequence(name, 12);
    const std::size_t elp = encode_sequence(sequence, options_with(Predictor::kElp)).size();
    const std::size_t pyramid = encode_sequence(sequence, options_with(Predictor::kPyramid)).size();
    const Stream both = encode_sequence(sequence, options_with(Predictor::kAuto));
    // It pays for the shape whatever it chooses, and each choice changes what the models learn.
    EXPECT_LT(static_cast<double>(both.size()), 1.02 * static_cast<double>(std::max(elp, pyramid))) << name;
    expect_same_frames(decode_stream(both),
                       decode_stream(encode_sequence(sequence, options_with(Predictor::kElp))));
  }
}

TEST(PyramidMode, TheBytesDoNotDependOnTheNumberOfThreadsNorTheFramesOnThePieces) {
  EncodeOptions options = options_with(Predictor::kAuto);
  options.fine_bits = 12;
  options.coarse_bits = 9;
  options.gop_frames = 3;
  const Sequence sequence = corpus_sequence("cloth", 14);
  const Stream one = encode_sequence(sequence, options);
  options.threads = 4;
  EXPECT_EQ(encode_sequence(sequence, options), one);
  const DecodedStream whole = decode_stream(one);
  EXPECT_TRUE(whole.complete && whole.damage.empty());
  expect_same_frames(whole, decode_pieces(one, [] { return 97; }));
}

TEST(PyramidMode, EachMeshOfAStreamHasAPyramidOfItsOwn) {
  std::mt19937 random(5);
  Stream stream;
  EncodeOptions options = options_with(Predictor::kPyramid);
  options.max_vertices = 500;
  options.max_faces = 1000;
  Encoder encoder(options, [&stream](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  });
  const std::vector<Sequence> sequences = {random_sequence(grid(10, 12), 5, random),
                                           random_sequence(closed_surface(9, 7), 3, random)};
  for (const Sequence& sequence : sequences) {
    ASSERT_TRUE(encoder.set_mesh(sequence.mesh).ok());
    for (const FramePositions& frame : sequence.frames) ASSERT_TRUE(encoder.add_frame(frame).ok());
  }
  ASSERT_TRUE(encoder.finish());
  const DecodedStream back = decode_stream(stream);
  ASSERT_TRUE(back.complete && back.damage.empty());
  ASSERT_EQ(back.frames.size(), 8u);
  ASSERT_EQ(back.meshes.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(sorted_faces(back.meshes[i].faces), sorted_faces(sequences[i].mesh.faces));
}

TEST(PyramidMode, FramesThatDoNotMoveTakeNextToNothing) {
  Sequence sequence = corpus_sequence("hand", 1);
  sequence.frames.resize(50, sequence.frames.front());
  EncodeOptions options = options_with(Predictor::kPyramid);
  options.gop_frames = 50;
  const std::size_t moving = encode_sequence(corpus_sequence("hand", 50), options).size();
  EXPECT_LT(encode_sequence(sequence, options).size(), moving / 4);
}

TEST(PyramidMode, AShapeForWhichTooLittleMemoryIsDeclaredIsRefused) {
  Stream stream = encode_sequence(corpus_sequence("cloth", 2), options_with(Predictor::kPyramid));
  StreamLimits limits = decode_stream(stream).head.limits;
  EXPECT_GE(limits.decoder_memory, decoder_memory_with_shapes(limits));
  const auto head_end =
      kSignature.size() + read_chunk_header(Bytes(stream).subspan(kSignature.size()))->total_size();
  limits.decoder_memory = decoder_memory_with_shapes(limits) - 1;
  Stream changed(kSignature.begin(), kSignature.end());
  const Stream head = write_chunk(kHeadChunk, false, write_head(limits));
  changed.insert(changed.end(), head.begin(), head.end());
  changed.insert(changed.end(), stream.begin() + static_cast<std::ptrdiff_t>(head_end), stream.end());
  const DecodedStream back = decode_stream(changed);
  EXPECT_TRUE(back.frames.empty());
  ASSERT_FALSE(back.damage.empty());
  EXPECT_EQ(back.damage.front().error.code, ErrorCode::kLimitExceeded);
  EXPECT_STREQ(back.damage.front().error.section, "§8.2");
}

}  // namespace
}  // namespace tvg::test
