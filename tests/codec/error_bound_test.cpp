#include "codec_toolbox.hpp"
#include "corpus/corpus.hpp"
#include "encoder/importers/open_source.hpp"

#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>

namespace tvg::test {
namespace {

/// Every coordinate lies within half a step of its own lattice, but for rounding to float32.
void expect_within_half_a_step(const Sequence& sequence, int fine_bits, int coarse_bits) {
  EncodeOptions options;
  options.fine_bits = fine_bits;
  options.coarse_bits = coarse_bits;
  options.gop_frames = 8;
  const DecodedStream back = decode_stream(encode_sequence(sequence, options));
  ASSERT_TRUE(back.complete && back.damage.empty());
  ASSERT_EQ(back.frames.size(), sequence.frames.size());
  for (const DecodedFrame& frame : back.frames) {
    const FramePositions& original = sequence.frames[frame.number];
    for (std::size_t i = 0; i < original.size(); ++i) {
      const int shift = frame.flags[i / 3] != 0 ? 0 : fine_bits - coarse_bits;
      const double half = std::ldexp(frame.gop.step, shift) / 2;
      const double rounding = std::abs(double{frame.positions[i]}) * 0x1p-24 + half * 1e-9;
      ASSERT_LE(std::abs(double{frame.positions[i]} - double{original[i]}), half + rounding)
          << fine_bits << ':' << coarse_bits << " frame " << frame.number << " vertex " << i / 3;
    }
  }
}

TEST(ErrorBound, IsHalfAStepOnTheCorpusAt7To16Bits) {
  for (const corpus::CorpusEntry& entry : corpus::corpus_entries()) {
    SCOPED_TRACE(std::string(entry.name));
    const Sequence sequence = entry.make(*corpus::named_size("small")).sequence;
    for (int bits = 7; bits <= 16; ++bits) {
      ASSERT_NO_FATAL_FAILURE(expect_within_half_a_step(sequence, bits, bits));
      ASSERT_NO_FATAL_FAILURE(expect_within_half_a_step(sequence, bits, bits - 2));
    }
  }
}

/// Where the real sequences are, or nothing.
std::filesystem::path data_folder() {
  const char* const variable = std::getenv("TVG_DATA_DIR");
  const std::filesystem::path folder = variable != nullptr ? variable : "";
  return std::filesystem::is_directory(folder) ? folder : std::filesystem::path();
}

Sequence read_real(const std::filesystem::path& mesh) {
  std::filesystem::path cache = mesh;
  cache.replace_extension(".pc2");
  const cli::OpenedSource opened = cli::open_source({{mesh.string(), cache.string()}, {}});
  Sequence sequence{opened.source->mesh(), {}, {}};
  constexpr std::size_t kFrames = 20;
  FramePositions frame(3 * std::size_t{sequence.mesh.vertex_count});
  while (sequence.frames.size() < kFrames) {
    const Result<bool> read = opened.source->read_frame(frame);
    if (!read || !*read) break;
    sequence.frames.push_back(frame);
  }
  return sequence;
}

TEST(ErrorBound, IsHalfAStepOnRealSequences) {
  const std::filesystem::path folder = data_folder();
  if (folder.empty()) GTEST_SKIP() << "no real sequences: set TVG_DATA_DIR to their folder";
  std::size_t sequences = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".obj") continue;
    SCOPED_TRACE(file.path().stem().string());
    const Sequence sequence = read_real(file.path());
    ASSERT_FALSE(sequence.frames.empty());
    for (const auto& [fine, coarse] :
         {std::pair(7, 7), std::pair(11, 9), std::pair(13, 11), std::pair(16, 16)}) {
      ASSERT_NO_FATAL_FAILURE(expect_within_half_a_step(sequence, fine, coarse));
    }
    ++sequences;
  }
  EXPECT_GT(sequences, 0u);
}

}  // namespace
}  // namespace tvg::test
