#include "c_api/encoder_script.hpp"

#include <gtest/gtest.h>
#include <random>

namespace tvg::test {
namespace {

/// A script with the calls that make two streams where they belong, and random ones between them.
std::vector<std::uint8_t> random_script(std::mt19937& random) {
  std::vector<std::uint8_t> script;
  const auto noise = [&](std::size_t most) {
    for (std::size_t count = random() % most; count > 0; --count)
      script.push_back(static_cast<std::uint8_t>(random()));
  };
  for (int stream = 0; stream < 2; ++stream) {
    script.push_back(static_cast<std::uint8_t>(random() % 4 == 0 ? random() & 0xF8 : 0));  // create
    noise(6);
    for (int mesh = 0; mesh < 2; ++mesh) {
      script.insert(script.end(), {2, static_cast<std::uint8_t>(3 + random() % 30), 6});
      for (int corner = 0; corner < 18; ++corner) script.push_back(static_cast<std::uint8_t>(random()));
      script.insert(script.end(), {4 | 5 << 3, static_cast<std::uint8_t>(random())});  // frames
      noise(20);
    }
    script.insert(script.end(), {6, 7, 7 | 1 << 3});  // finish, compare, join
  }
  noise(80);
  return script;
}

TEST(CEncoder, RandomCallOrdersNeverCrashAndWhatIsFinishedDecodes) {
  std::mt19937 random(5);
  for (int round = 0; round < 1500; ++round) {
    const std::vector<std::uint8_t> script = random_script(random);
    ASSERT_EQ(EncoderScript(script).run(), "") << "round " << round;
  }
}

TEST(CEncoder, TheLargestErrorOfABasisCountsWhatItWasRoundedByItself) {
  const std::vector<std::uint8_t> script = {
      0x40, 0x02, 0x1e, 0x1e, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x24, 0x00, 0x00,
      0x00, 0x02, 0x01, 0x05, 0x03, 0x00, 0x02, 0x04, 0x02, 0x00, 0x01, 0x02, 0x00, 0x02, 0x03, 0x33,
      0x07, 0x03, 0x09, 0x02, 0x03, 0x03, 0x00, 0x02, 0x04, 0x02, 0x00, 0x01, 0x02, 0x00, 0x02, 0x03,
      0x35, 0x07, 0x03, 0x09, 0x02, 0x03, 0x28, 0x70, 0x08, 0x14, 0x3c, 0x74, 0x01, 0x02, 0x04, 0x02,
      0x00, 0x02, 0x00, 0x01, 0x02, 0x00, 0x02, 0x03, 0x14, 0x08, 0x06, 0x07, 0x0f};
  EXPECT_EQ(EncoderScript(script).run(), "");
}

}  // namespace
}  // namespace tvg::test
