#include "decoder/damage.hpp"

#include <gtest/gtest.h>

namespace tvg {
namespace {

TEST(DamageLedger, LabelsThatAreMadeUpNeverCountFurtherThanALabelCan) {
  constexpr std::uint64_t kLargestLabel = std::uint64_t{1} << 62;
  DamageLedger frames;
  for (int i = 0; i < 10; ++i) {
    for (const std::uint64_t label : {kLargestLabel, std::uint64_t{0}}) {
      const std::uint64_t before = frames.position();
      frames.search();
      const std::uint64_t missing = frames.meet_gop(label, 3, nullptr);
      if (missing > 0) frames.lose(missing, frames.take_cause({}));
      frames.advance(3);
      EXPECT_GE(frames.position(), before + 3);
      EXPECT_LE(frames.position(), kLargestLabel + 60);
    }
  }
}

}  // namespace
}  // namespace tvg
