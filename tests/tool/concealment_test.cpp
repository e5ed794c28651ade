#include "tool/concealment.hpp"

#include "tests/importers/io_toolbox.hpp"

#include <gmock/gmock.h>
#include <limits>

namespace tvg::cli {
namespace {

using ::testing::HasSubstr;
using testing::thrown_by;
using ::testing::internal::CaptureStderr;
using ::testing::internal::GetCapturedStderr;

Damage damage(std::uint64_t first, std::uint64_t count, std::uint64_t offset = 100) {
  Damage damage;
  damage.first_frame = first;
  damage.frame_count = count;
  damage.error.code = ErrorCode::kChecksumMismatch;
  damage.error.byte_offset = offset;
  damage.error.message = "the checksum is wrong";
  return damage;
}

TEST(Concealment, WithoutItALossEndsTheCommand) {
  Concealment concealment("a.tvg", false);
  const ToolError error = thrown_by([&] { concealment.hold(damage(5, 3), {}, "nothing was written"); });
  EXPECT_EQ(error.status(), ExitStatus::kInvalidInput);
  EXPECT_THAT(error.what(), HasSubstr("a.tvg: frames 5-7 lost: "));
  EXPECT_THAT(error.what(), HasSubstr("; nothing was written (--conceal holds"));
}

TEST(Concealment, HoldsTheWantedFramesAndTellsOnce) {
  Concealment concealment("a.tvg", true);
  CaptureStderr();
  const auto held = concealment.hold(damage(5, 10), FrameRange{8, 11});
  ASSERT_TRUE(held);
  EXPECT_EQ(held->first, 8U);
  EXPECT_EQ(held->end, 12U);
  EXPECT_FALSE(concealment.hold(damage(5, 3), FrameRange{8, 11}));
  EXPECT_TRUE(concealment.hold(damage(0, 0, 7), {}));
  concealment.tell(damage(0, 0, 7).error);  // the same again
  concealment.fall_silent();
  concealment.tell(damage(0, 0, 9).error);
  const std::string told = GetCapturedStderr();
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 2) << told;
}

TEST(Concealment, ADamagedNumberFillsNoDisk) {
  Concealment concealment("a.tvg", true);
  constexpr auto kLast = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(thrown_by([&] { concealment.hold(damage(5, (1U << 20) + 1), {}); }).status(),
            ExitStatus::kInvalidInput);
  EXPECT_FALSE(concealment.hold(damage(kLast - 1, kLast), FrameRange{0, kLast - 2}));
  EXPECT_TRUE(concealment.hold(damage(0, kLast), FrameRange{0, 9}));
}

}  // namespace
}  // namespace tvg::cli
