#include "server_toolbox.hpp"

#include <nlohmann/json.hpp>

namespace tvg::server::testing {
namespace {

/// Streams in mode basis, with a period of as many GOPs.
class LiveBasis : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(LiveBasis, WhoJoinsLaterIsGivenThePlanesOfTheNewestGop) {
  constexpr std::size_t kGops = 8, kBefore = 6;
  const cli::testing::TemporaryFolder folder;
  const RunningServer server(folder.path(""));
  const test::Stream stream = make_live_basis(kGops, GetParam());
  const test::DecodedStream encoded = test::decode_stream(stream);
  const std::size_t border = gop_borders(stream).at(kBefore);
  Upload upload(server, "/live/cam");
  upload.send(text_of(stream, 0, border));
  ASSERT_TRUE(eventually([&] {
    auto answer = server.client().Get("/live/");
    if (!answer) return false;
    const nlohmann::json streams = nlohmann::json::parse(answer->body)["streams"];
    return !streams.empty() && streams[0]["gops"] == kBefore;
  }));
  Viewer viewer(server, "/live/cam");
  EXPECT_TRUE(eventually([&] { return decode_text(viewer.received()).frames.size() == 2; }));
  upload.send(text_of(stream, border, stream.size()));
  upload.finish();
  viewer.wait();
  const test::DecodedStream viewed = decode_text(viewer.received());
  EXPECT_TRUE(viewed.complete) << viewed.error.describe();
  EXPECT_TRUE(viewed.damage.empty());
  const std::size_t first = 2 * (kBefore - 1);
  ASSERT_EQ(viewed.frames.size(), encoded.frames.size() - first);
  for (std::size_t f = 0; f < viewed.frames.size(); ++f)
    EXPECT_EQ(viewed.frames[f].positions, encoded.frames[first + f].positions) << f;
}

INSTANTIATE_TEST_SUITE_P(OfGops, LiveBasis, ::testing::Values(1u, 4u));

}  // namespace
}  // namespace tvg::server::testing
