#include "player/frames/shown_frames.hpp"

#include "corpus/corpus.hpp"
#include "corpus/write_cache.hpp"
#include "encoder/importers/open_source.hpp"
#include "player/overlay/overlay_values.hpp"
#include "player/render/whole_gops.hpp"
#include "tests/importers/io_toolbox.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include <tvg/encoder.hpp>

namespace tvg::player {
namespace {

constexpr std::uint32_t kGop = 5;
constexpr float kLargest = 0.25F;

/// The same sequence as a stream and as mesh and cache.
class Shown : public ::testing::Test {
 protected:
  Shown() : hand_(corpus::find_corpus_entry("hand")->make({400, 12}).sequence) {
    EncodeOptions options;
    options.fine_bits = 14;
    options.coarse_bits = 11;
    options.gop_frames = kGop;
    std::string bytes;
    SequenceSource source(hand_);
    EXPECT_TRUE(encode(source, options, [&bytes](std::span<const std::uint8_t> piece) {
      bytes.append(reinterpret_cast<const char*>(piece.data()), piece.size());
      return Status();
    }));
    folder_.write("hand.tvg", bytes);
    corpus::write_obj(folder_.path("hand.obj"), hand_);
    corpus::write_pc2(folder_.path("hand.pc2"), hand_);
  }

  ShownFramesSpec stream() const {
    ShownFramesSpec spec;
    spec.inputs = {folder_.path("hand.tvg")};
    return spec;
  }
  ShownFramesSpec files() const {
    ShownFramesSpec spec;
    spec.inputs = {folder_.path("hand.obj"), folder_.path("hand.pc2")};
    spec.open_source = [](const auto& inputs, const auto& frames) {
      return cli::open_source({inputs, frames}).source;
    };
    return spec;
  }

  static std::vector<ShownFrame> all(ShownFrames& frames) {
    std::vector<ShownFrame> result;
    for (ShownFrame frame; frames.next(frame);) result.push_back(frame);
    return result;
  }

  cli::testing::TemporaryFolder folder_;
  Sequence hand_;
};

TEST_F(Shown, RangesGiveTheFramesOfTheWhole) {
  for (const ShownFramesSpec& whole : {stream(), files()}) {
    const std::vector<ShownFrame> every = all(*open_frames(whole));
    ASSERT_EQ(every.size(), 12U);
    for (const FrameRange range :
         {FrameRange{0, 0}, FrameRange{3, 8}, FrameRange{5, 5}, FrameRange{11, 11}}) {
      ShownFramesSpec spec = whole;
      spec.frames = range;
      const std::vector<ShownFrame> some = all(*open_frames(spec));
      ASSERT_EQ(some.size(), range.last - range.first + 1);
      for (std::size_t i = 0; i < some.size(); ++i) {
        EXPECT_EQ(some[i].number, range.first + i);
        EXPECT_EQ(some[i].positions, every[range.first + i].positions);
      }
    }
  }
}

TEST_F(Shown, ComeAgainAfterRewinding) {
  for (ShownFramesSpec spec : {stream(), files()}) {
    spec.frames = FrameRange{4, 9};
    const auto frames = open_frames(spec);
    const std::vector<ShownFrame> first = all(*frames);
    ASSERT_TRUE(frames->rewind());
    const std::vector<ShownFrame> second = all(*frames);
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].positions, second[i].positions);
  }
}

TEST_F(Shown, CostIsThatOfTheWholeGopWhateverTheRange) {
  const std::vector<ShownFrame> plain = all(*open_frames(stream()));
  ShownFramesSpec spec = stream();
  spec.whole_gops = true;
  for (const FrameRange range : {FrameRange{0, 11}, FrameRange{7, 7}, FrameRange{3, 6}, FrameRange{10, 11}}) {
    spec.frames = range;
    const auto colours = make_overlay_colours({Overlay::kCost, kLargest, nullptr});
    const auto frames = with_whole_gops(open_frames(spec), range, *colours);
    std::uint64_t number = range.first;
    for (ShownFrame frame; frames->next(frame); ++number) {
      EXPECT_EQ(frame.number, number);
      const std::size_t begin = frame.number / kGop * kGop;
      std::vector<FramePositions> gop;
      for (std::size_t f = begin; f < std::min<std::size_t>(begin + kGop, 12); ++f) {
        gop.push_back(plain[f].positions);
      }
      EXPECT_EQ(frame.positions, plain[frame.number].positions);
      colours->colour({frame.number, *frame.mesh, frame.positions, {}}, frame.values);
      std::vector<float> expected = cost_values(hand_.mesh, {gop});
      cli::scale_values(expected, {0, kLargest});
      EXPECT_EQ(frame.values, expected) << frame.number;
    }
    EXPECT_EQ(number, range.last + 1);
  }
}

TEST_F(Shown, FlagsAreThoseOfTheGop) {
  ShownFramesSpec spec = stream();
  spec.flags = true;
  for (const ShownFrame& frame : all(*open_frames(spec))) {
    ASSERT_NE(frame.flags, nullptr);
    const auto flagged = std::count(frame.flags->begin(), frame.flags->end(), 1);
    EXPECT_NEAR(static_cast<double>(flagged) / static_cast<double>(frame.flags->size()), 0.35, 0.01);
  }
  spec.inputs = files().inputs;
  EXPECT_THROW(open_frames(spec), cli::ToolError);
}

TEST_F(Shown, DamageIsAnErrorOrTheLastGoodFrameAgain) {
  const std::vector<ShownFrame> good = all(*open_frames(stream()));
  std::string bytes = folder_.read("hand.tvg");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x20);
  folder_.write("hand.tvg", bytes);
  EXPECT_THROW(all(*open_frames(stream())), cli::ToolError);
  ShownFramesSpec spec = stream();
  spec.conceal = true;
  const std::vector<ShownFrame> frames = all(*open_frames(spec));
  ASSERT_EQ(frames.size(), good.size());
  std::size_t held = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].number, i);
    if (frames[i].positions == good[i].positions) continue;
    ASSERT_GT(i, 0U);
    EXPECT_EQ(frames[i].positions, frames[i - 1].positions);
    ++held;
  }
  EXPECT_GT(held, 0U);
  EXPECT_LE(held, kGop);
}

}  // namespace
}  // namespace tvg::player
