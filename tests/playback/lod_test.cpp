#include "playback_toolbox.hpp"
#include "player/playback/stream_loader.hpp"
#include "tests/codec/levels_toolbox.hpp"

// What the player reads of a stream for a coarser mesh.
namespace tvg::test {
namespace {

using player::LoaderSnapshot;
using player::StreamLoader;

TEST(StreamLoader, ReadsLessOfAStreamForACoarserMesh) {
  const Sequence sequence = corpus::find_corpus_entry("hand")->make({1500, 12}).sequence;
  EncodeOptions options;
  options.mode = Mode::kBasis;
  options.fine_bits = options.coarse_bits = 14;
  options.period_frames = 6;
  options.gop_frames = 3;
  options.levels = greedy_levels(sequence.mesh, 6, {6});
  const TemporaryFile file(encode_sequence(sequence, options));
  std::uint64_t read_for[2] = {};
  for (const std::uint32_t lod : {0u, 1u}) {
    StreamLoader loader(player::open_stream_input(file.path()), {.lod = lod});
    ASSERT_TRUE(eventually([&] { return loader.snapshot().state == LoaderSnapshot::State::kEnded; }));
    const LoaderSnapshot snapshot = loader.snapshot();
    EXPECT_EQ(snapshot.frames_decoded, 12u);
    EXPECT_EQ(snapshot.lod, lod);
    EXPECT_EQ(snapshot.lods, 1u);
    EXPECT_TRUE(snapshot.damage.empty());
    read_for[lod] = snapshot.bytes_read;
  }
  EXPECT_LT(read_for[1], read_for[0]);
}

}  // namespace
}  // namespace tvg::test
