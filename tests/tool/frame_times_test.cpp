#include "tool/frame_times.hpp"

#include <bit>
#include <gtest/gtest.h>

namespace tvg::cli {
namespace {

std::vector<std::uint8_t> bytes_of(const std::vector<double>& times) {
  std::vector<std::uint8_t> bytes;
  for (const double time : times) {
    for (int i = 0; i < 8; ++i)
      bytes.push_back(static_cast<std::uint8_t>(std::bit_cast<std::uint64_t>(time) >> (8 * i)));
  }
  return bytes;
}

TEST(FrameTimes, AreThoseThatRise) {
  EXPECT_EQ(times_from(bytes_of({-1, 0, 2.5})), (std::vector<double>{-1, 0, 2.5}));
  EXPECT_TRUE(times_from(bytes_of({0, 1, 1})).empty());
  EXPECT_TRUE(times_from(bytes_of({0, std::bit_cast<double>(0x7ff8000000000000)})).empty());
  EXPECT_TRUE(times_from(std::vector<std::uint8_t>(7)).empty());
}

TEST(FrameTimes, MakeALineThatGoesOnAtTheRate) {
  const std::vector<double> times = {2, 3, 7};
  const FrameTimeline line(times, 10);
  EXPECT_DOUBLE_EQ(line.time_at(1.5), 3);
  EXPECT_DOUBLE_EQ(line.time_at(4), 5.2);
  for (const double frame : {0.0, 0.25, 1.0, 1.5, 2.0, 7.0})
    EXPECT_NEAR(line.frame_at(line.time_at(frame)), frame, 1e-9);
  EXPECT_DOUBLE_EQ(FrameTimeline({}, 10).frame_at(0.5), 5);
}

}  // namespace
}  // namespace tvg::cli
