#include "player/overlay/overlay_values.hpp"

#include "corpus/corpus.hpp"

#include <gtest/gtest.h>
#include <limits>

#include <tvg/decoder.hpp>
#include <tvg/encoder.hpp>

namespace tvg::player {
namespace {

TEST(CostOverlay, RanksVerticesAsTheEncoderDoes) {
  const Sequence hand = corpus::find_corpus_entry("hand")->make({400, 10}).sequence;
  EncodeOptions options;
  options.fine_bits = 16;
  options.coarse_bits = 12;
  Decoder decoder;
  SequenceSource source(hand);
  ASSERT_TRUE(encode(source, options, [&decoder](std::span<const std::uint8_t> bytes) {
    decoder.push(bytes);
    return Status();
  }));
  decoder.finish();
  while (decoder.poll() != Decoder::Event::kFrame) {
  }
  std::vector<std::uint8_t> flags(hand.mesh.vertex_count);
  decoder.copy_flags(flags);

  const std::vector<float> costs = cost_values(hand.mesh, {hand.frames});
  float least_important = std::numeric_limits<float>::infinity();
  float most_plain = 0;
  for (std::size_t v = 0; v < flags.size(); ++v) {
    if (flags[v] != 0) {
      least_important = std::min(least_important, costs[v]);
    } else {
      most_plain = std::max(most_plain, costs[v]);
    }
  }
  EXPECT_GE(least_important, most_plain);
}

TEST(ErrorOverlay, IsTheDistanceOfEachVertex) {
  const std::vector<float> frame = {0, 0, 0, 1, 2, 3};
  const std::vector<float> reference = {3, 4, 0, 1, 2, 3};
  std::vector<float> values(2);
  error_values(frame, reference, values);
  EXPECT_EQ(values, (std::vector<float>{5, 0}));
}

TEST(ImportanceOverlay, IsOneForFlaggedVertices) {
  std::vector<float> values(3, 9.0F);
  importance_values(std::vector<std::uint8_t>{1, 0, 1}, values);
  EXPECT_EQ(values, (std::vector<float>{1, 0, 1}));
}

}  // namespace
}  // namespace tvg::player
