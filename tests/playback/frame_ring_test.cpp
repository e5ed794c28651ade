#include "player/playback/frame_ring.hpp"

#include "player/playback/frame_pool.hpp"

#include <gtest/gtest.h>

namespace tvg::player {
namespace {

std::shared_ptr<PlayerFrame> frame(std::uint64_t number) {
  auto made = std::make_shared<PlayerFrame>();
  made->number = number;
  return made;
}

void fill(FrameRing& ring, std::uint64_t first, std::uint64_t last) {
  for (std::uint64_t f = first; f <= last; ++f) {
    ASSERT_TRUE(ring.has_room()) << f;
    ring.push(frame(f));
  }
}

TEST(FrameRing, NeverHoldsMoreThanItsCapacity) {
  FrameRing ring(8);
  for (std::uint64_t f = 0; f < 100; ++f) {
    while (ring.has_room()) {
      ring.push(frame(ring.next()));
      ASSERT_LE(ring.size(), 8u);
    }
    ASSERT_TRUE(ring.show(f));
    EXPECT_GE(ring.ahead(), 4u);
  }
}

TEST(FrameRing, KeepsSomeFramesBehindTheOneShown) {
  FrameRing ring(8);
  fill(ring, 0, 7);
  EXPECT_FALSE(ring.has_room());
  ASSERT_EQ(ring.show(2)->number, 2u);
  EXPECT_FALSE(ring.has_room());
  ASSERT_EQ(ring.show(3)->number, 3u);
  fill(ring, 8, 8);
  EXPECT_FALSE(ring.has_room());
  EXPECT_EQ(ring.show(2)->number, 2u) << "a step back";
  EXPECT_EQ(ring.show(1)->number, 1u);
  EXPECT_FALSE(ring.contains(0));
}

TEST(FrameRing, TheLastGoodFrameStandsInForLostOnes) {
  FrameRing ring(16);
  ring.reset(10);
  EXPECT_FALSE(ring.contains(10));
  fill(ring, 12, 14);
  EXPECT_EQ(ring.show(10)->number, 12u) << "lost before the first good one";
  EXPECT_FALSE(ring.contains(9));
  ring.pass_over(15, 5);
  EXPECT_EQ(ring.show(19)->number, 14u) << "told at once";
  EXPECT_FALSE(ring.contains(20));
  ring.push(frame(22));
  EXPECT_EQ(ring.show(21)->number, 14u) << "seen by the number that follows";
  EXPECT_EQ(ring.show(22)->number, 22u);
  ring.close(25, 25);
  EXPECT_EQ(ring.show(24)->number, 22u) << "up to the end";
  EXPECT_FALSE(ring.contains(25));
  EXPECT_EQ(ring.runs(), (std::vector<FrameRun>{{10, 15}}));
}

TEST(FrameRing, ALoopGoesOnWithItsFirstFrame) {
  FrameRing ring(16);
  ring.reset(6);
  fill(ring, 6, 8);
  ring.close(10, 2);
  fill(ring, 3, 5);
  EXPECT_EQ(ring.next(), 6u);
  EXPECT_EQ(ring.show(9)->number, 8u);
  EXPECT_EQ(ring.show(2)->number, 3u);
  EXPECT_EQ(ring.ahead(), 2u);
  EXPECT_EQ(ring.runs(), (std::vector<FrameRun>{{2, 8}}));
}

TEST(FramePool, UsesAFrameAgainOnceNobodyHoldsIt) {
  FramePool pool{std::make_shared<Bell>()};
  pool.set_limit(2);
  std::shared_ptr<const PlayerFrame> first = pool.take();
  const std::shared_ptr<const PlayerFrame> second = pool.take();
  EXPECT_FALSE(pool.has_free());
  EXPECT_EQ(pool.take(), nullptr);
  const PlayerFrame* const address = first.get();
  first.reset();
  EXPECT_TRUE(pool.has_free());
  EXPECT_EQ(pool.take().get(), address);
  EXPECT_EQ(pool.size(), 2u);
}

}  // namespace
}  // namespace tvg::player
