#include "player/playback/http_input.hpp"

#include "player/playback/player.hpp"
#include "stream_server.hpp"

#include <gmock/gmock.h>

namespace tvg::test {
namespace {

using player::HttpInput;
using player::HttpOptions;
using player::StreamLoader;
using std::chrono::milliseconds;
using testing::Contains;
using testing::HasSubstr;

/// Gives up soon, so that failures are seen soon.
HttpOptions hasty() {
  HttpOptions options;
  options.first_delay = milliseconds(5);
  options.stall_timeout = milliseconds(200);
  options.connect_timeout = milliseconds(2000);
  return options;
}

HttpOptions patient() {
  HttpOptions options = hasty();
  options.stall_timeout = milliseconds(30000);
  return options;
}

/// A stream of about 500 kB and its frames.
const Stream& long_stream() {
  static const Stream kStream = [] {
    EncodeOptions options;
    options.fine_bits = options.coarse_bits = 15;
    options.gop_frames = 5;
    return encode_sequence(corpus::make_cloth({2500, 60}), options);
  }();
  return kStream;
}

const DecodedStream& long_frames() {
  static const DecodedStream kFrames = decode_stream(long_stream());
  return kFrames;
}

void expect_all_frames(StreamLoader& loader) {
  for (const DecodedFrame& frame : long_frames().frames) ASSERT_NO_FATAL_FAILURE(expect_frame(loader, frame));
}

std::string failure_of(StreamLoader& loader) {
  EXPECT_TRUE(eventually([&] {
    loader.show(loader.snapshot().known_frames);
    return loader.supply().failed;
  }));
  return loader.snapshot().message;
}

/// Reads to the end or to the first failure.
Result<Stream> read_all(HttpInput& input) {
  Stream bytes;
  std::vector<std::uint8_t> piece(5000);
  for (;;) {
    const Result<std::size_t> count = input.read(bytes.size(), piece);
    if (!count) return count.error();
    if (*count == 0) return bytes;
    bytes.insert(bytes.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(*count));
  }
}

TEST(HttpInput, AWholeStreamComesInOneRequestAndItsIndexInAnother) {
  ASSERT_GT(long_stream().size(), 300'000u);
  StreamServer server(long_stream(), {});
  StreamLoader loader(std::make_unique<HttpInput>(server.url(), patient()));
  expect_all_frames(loader);
  ASSERT_TRUE(eventually([&] { return loader.snapshot().has_index; }));
  EXPECT_EQ(loader.snapshot().frame_count, 60u);
  EXPECT_LE(server.requests().size(), 2u);
}

TEST(HttpInput, FramesComeBeforeTheDownloadIsOver) {
  StreamServer::Behaviour behaviour;
  behaviour.hang_after = 200'000;
  StreamServer server(long_stream(), behaviour);
  StreamLoader loader(std::make_unique<HttpInput>(server.url(), patient()));
  for (int f = 0; f < 10; ++f) expect_frame(loader, long_frames().frames[f]);
  const player::LoaderSnapshot snapshot = loader.snapshot();
  EXPECT_LT(snapshot.input.bytes_received, long_stream().size());
}

TEST(HttpInput, ASeekAsksForTheBytesOfItsGopOnly) {
  StreamServer::Behaviour behaviour;
  behaviour.hang_after = 100'000;
  StreamServer server(long_stream(), behaviour);
  StreamLoader loader(std::make_unique<HttpInput>(server.url(), patient()));
  expect_frame(loader, long_frames().frames[0]);
  loader.seek(52);
  expect_frame(loader, long_frames().frames[52]);
  const player::GopMarks gops = loader.snapshot().gops;
  ASSERT_EQ(gops->size(), 12u);
  ASSERT_EQ((*gops)[10].first_frame, 50u);
  const std::vector<std::string> requests = server.requests();
  EXPECT_THAT(requests, Contains("bytes=" + std::to_string((*gops)[10].offset) + "-"));
  const std::uint64_t size = long_stream().size();
  EXPECT_THAT(requests, Contains("bytes=" + std::to_string(size - 65536) + "-" + std::to_string(size - 1)));
  loader.seek(1);
  expect_frame(loader, long_frames().frames[1]);
  EXPECT_EQ(loader.snapshot().damage.size(), 0u);
}

TEST(HttpInput, ASeekInABasisAsksForThePlanesOfItsPeriod) {
  const DecodedStream plain = decode_stream(basis_of_noise());
  const std::uint64_t plan = last_of(plain.index, IndexEntry::Kind::kPlan);
  StreamServer::Behaviour behaviour;
  behaviour.hang_after = static_cast<std::size_t>(plan) / 2;
  StreamServer server(basis_of_noise(), behaviour);
  StreamLoader loader(std::make_unique<HttpInput>(server.url(), patient()));
  expect_frame(loader, plain.frames[0]);
  loader.seek(62);
  expect_frame(loader, plain.frames[62]);
  EXPECT_THAT(server.requests(), Contains("bytes=" + std::to_string(plan) + "-"));
  EXPECT_EQ(loader.snapshot().damage.size(), 0u);
}

TEST(HttpInput, ABrokenConnectionIsResumedWhereItBroke) {
  StreamServer::Behaviour behaviour;
  behaviour.break_after = 50'000;
  behaviour.breaks = 6;
  StreamServer server(long_stream(), behaviour);
  StreamLoader loader(std::make_unique<HttpInput>(server.url(), patient()));
  expect_all_frames(loader);
  EXPECT_GE(server.requests().size(), 7u);
  EXPECT_TRUE(loader.snapshot().damage.empty());
}

TEST(HttpInput, ASlowServerGivesTheSameFrames) {
  StreamServer::Behaviour behaviour;
  behaviour.pause = milliseconds(1);
  StreamServer server(long_stream(), behaviour);
  StreamLoader loader(std::make_unique<HttpInput>(server.url(), patient()));
  expect_all_frames(loader);
}

TEST(HttpInput, WithoutRangesAStreamIsReadFrontToBackAndWhatCameCanBeRevisited) {
  StreamServer::Behaviour behaviour;
  behaviour.ranges = false;
  StreamServer server(long_stream(), behaviour);
  StreamLoader loader(std::make_unique<HttpInput>(server.url(), patient()));
  expect_frame(loader, long_frames().frames[0]);
  loader.seek(57);
  expect_frame(loader, long_frames().frames[57]);
  loader.seek(8);
  expect_frame(loader, long_frames().frames[8]);
  EXPECT_EQ(loader.snapshot().message, "");
}

TEST(HttpInput, WithoutRangesABrokenConnectionIsReadAgainFromTheStart) {
  StreamServer::Behaviour behaviour;
  behaviour.ranges = false;
  behaviour.break_after = 250'000;
  behaviour.breaks = 2;
  StreamServer server(long_stream(), behaviour);
  HttpInput input(server.url(), patient());
  const Result<Stream> bytes = read_all(input);
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_EQ(*bytes, long_stream());
}

TEST(HttpInput, AResourceThatChangesUnderWayIsAnError) {
  StreamServer::Behaviour behaviour;
  behaviour.later_etag = "\"two\"";
  behaviour.break_after = 50'000;
  behaviour.breaks = 1;
  StreamServer server(long_stream(), behaviour);
  HttpInput input(server.url(), patient());
  const Result<Stream> bytes = read_all(input);
  ASSERT_FALSE(bytes);
  EXPECT_THAT(bytes.error().message, HasSubstr("has changed"));
  EXPECT_THAT(bytes.error().message, HasSubstr(server.url()));
}

TEST(HttpInput, NotFoundIsToldAtOnceWithUrlAndStatus) {
  StreamServer::Behaviour behaviour;
  behaviour.refusals = 100;
  behaviour.refusal = 404;
  StreamServer server(long_stream(), behaviour);
  StreamLoader loader(std::make_unique<HttpInput>(server.url(), patient()));
  const std::string message = failure_of(loader);
  EXPECT_THAT(message, HasSubstr("404"));
  EXPECT_THAT(message, HasSubstr(server.url()));
  EXPECT_EQ(server.requests().size(), 1u);
}

TEST(HttpInput, AServerThatIsBusyIsAskedAgain) {
  StreamServer::Behaviour behaviour;
  behaviour.refusals = 2;
  StreamServer server(long_stream(), behaviour);
  HttpInput input(server.url(), patient());
  const Result<Stream> bytes = read_all(input);
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_EQ(*bytes, long_stream());
  EXPECT_EQ(server.requests().size(), 3u);
}

TEST(HttpInput, ALengthThatIsNotKeptEndsInAnErrorAfterBoundedAttempts) {
  StreamServer::Behaviour behaviour;
  behaviour.extra_length = 1000;
  StreamServer server(long_stream(), behaviour);
  HttpInput input(server.url(), patient());
  const Result<Stream> bytes = read_all(input);
  ASSERT_FALSE(bytes);
  EXPECT_THAT(bytes.error().message, HasSubstr("attempts"));
  EXPECT_LE(server.requests().size(), 10u);
}

TEST(HttpInput, FollowsFiveRedirectsAndNoMoreAndNoneToAFile) {
  StreamServer server(long_stream(), {});
  HttpInput led(server.url("/redirected/5"), patient());
  const Result<Stream> bytes = read_all(led);
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_EQ(*bytes, long_stream());
  const std::size_t requests = server.requests().size();
  for (const char* path : {"/redirected/6", "/to-a-file"}) {
    HttpInput misled(server.url(path), hasty());
    const Result<Stream> nothing = read_all(misled);
    ASSERT_FALSE(nothing) << path;
    EXPECT_FALSE(nothing.error().message.empty());
  }
  EXPECT_EQ(server.requests().size(), requests) << "the stream was not reached";
}

TEST(HttpInput, AServerThatHangsIsGivenUpAfterBoundedAttempts) {
  StreamServer::Behaviour behaviour;
  behaviour.hang_after = 0;
  StreamServer server(long_stream(), behaviour);
  HttpInput input(server.url(), hasty());
  const Result<Stream> bytes = read_all(input);
  ASSERT_FALSE(bytes);
  EXPECT_THAT(bytes.error().message, HasSubstr("nothing has come for 0.2 s"));
}

TEST(HttpInput, AStallIsOvercomeByARange) {
  StreamServer::Behaviour behaviour;
  behaviour.hang_after = 100'000;
  StreamServer server(long_stream(), behaviour);
  HttpInput input(server.url(), hasty());
  const Result<Stream> bytes = read_all(input);
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_EQ(*bytes, long_stream());
}

TEST(HttpInput, NobodyListeningIsAnErrorThatNamesTheUrl) {
  std::string url;
  {
    const StreamServer gone(long_stream(), {});
    url = gone.url();
  }
  HttpInput input(url, hasty());
  const Result<Stream> bytes = read_all(input);
  ASSERT_FALSE(bytes);
  EXPECT_THAT(bytes.error().message, HasSubstr(url));
}

TEST(HttpInput, APasswordInTheUrlIsNotShown) {
  const HttpInput input("http://user:secret@127.0.0.1:1/a@b.tvg", hasty());
  EXPECT_EQ(input.name(), "http://127.0.0.1:1/a@b.tvg");
}

TEST(HttpInput, ALiveStreamPlaysToItsEnd) {
  StreamServer::Behaviour behaviour;
  behaviour.live = true;
  StreamServer server(long_stream(), behaviour);
  StreamLoader loader(std::make_unique<HttpInput>(server.url(), patient()));
  expect_all_frames(loader);
  ASSERT_TRUE(eventually([&] { return loader.snapshot().state == player::LoaderSnapshot::State::kEnded; }));
  EXPECT_EQ(loader.snapshot().frame_count, 60u);
}

TEST(HttpInput, ALiveStreamThatBreaksOffIsOpenedAgainAndCountsOn) {
  StreamServer::Behaviour behaviour;
  behaviour.live = true;
  behaviour.break_after = 200'000;
  behaviour.breaks = 1;
  StreamServer server(long_stream(), behaviour);
  StreamLoader loader(std::make_unique<HttpInput>(server.url(), patient()));
  std::uint64_t number = 0;
  std::shared_ptr<const player::PlayerFrame> frame;
  ASSERT_TRUE(eventually([&] {
    frame = loader.show(number);
    if (frame) ++number;
    return loader.snapshot().state == player::LoaderSnapshot::State::kEnded && !frame;
  })) << loader.snapshot().message;
  EXPECT_GT(number, 60u) << "the frames of both";
  EXPECT_LT(number, 120u);
  const auto last = loader.show(number - 1);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->positions, long_frames().frames[59].positions);
}

TEST(HttpInput, EndsWhileItWaitsForTheNetwork) {
  StreamServer::Behaviour behaviour;
  behaviour.hang_after = 100'000;
  behaviour.ranges = false;
  StreamServer server(long_stream(), behaviour);
  HttpOptions options = patient();
  options.stall_timeout = std::chrono::hours(24);  // a test that hangs until then has failed
  StreamLoader loader(std::make_unique<HttpInput>(server.url(), options));
  await_frame(loader, 0);
  loader.seek(59);
}

TEST(HttpInput, FetchesNoFurtherAheadThanAllowed) {
  StreamServer server(long_stream(), {});
  HttpOptions options = patient();
  options.read_ahead = 128 << 10;
  HttpInput input(server.url(), options);
  std::vector<std::uint8_t> piece(1000);
  ASSERT_TRUE(input.read(0, piece));
  ASSERT_TRUE(eventually([&] { return input.status().activity == player::InputStatus::Activity::kResting; }));
  EXPECT_LE(input.status().bytes_received, (128u << 10) + (64u << 10));
  const Result<Stream> bytes = read_all(input);
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_EQ(*bytes, long_stream());
}

}  // namespace
}  // namespace tvg::test
