#include "server/live_hub.hpp"

#include "server_toolbox.hpp"
#include "tests/container/plan_streams.hpp"

namespace tvg::server::testing {
namespace {

constexpr std::chrono::milliseconds kNow{0};
constexpr std::uint64_t kRoom = 1u << 20;

std::vector<StreamPart> parts_of(const test::Stream& stream) {
  StreamSplitter splitter;
  EXPECT_TRUE(splitter.push(stream).ok());
  std::vector<StreamPart> parts;
  for (;;) {
    Result<std::optional<StreamPart>> part = splitter.next();
    EXPECT_TRUE(part);
    if (!part || !*part) return parts;
    parts.push_back(std::move(**part));
  }
}

/// The parts of a stream of `gops` GOPs.
std::vector<StreamPart> make_parts(std::size_t gops) {
  return parts_of(make_live_stream(gops));
}

/// Steps a viewer until it has nothing more to write now.
std::string take_all(LiveViewer& viewer) {
  std::string bytes;
  const ByteSink sink = [&](std::span<const std::uint8_t> piece) {
    bytes.append(piece.begin(), piece.end());
    return Status();
  };
  for (std::size_t before = 1; before > 0;) {
    before = bytes.size();
    if (viewer.step(sink, kNow) != LiveViewer::Step::kGoOn) break;
    before = bytes.size() - before;
  }
  return bytes;
}

TEST(LiveHub, AViewerThatFallsBehindSkipsToTheNewestGop) {
  LiveStream stream(kRoom);
  const std::vector<StreamPart> parts = make_parts(12);  // head, mesh, 12 GOPs, end
  for (std::size_t i = 0; i < 3; ++i) stream.add(parts[i]);
  LiveGop gop;
  ASSERT_EQ(stream.next(std::nullopt, kNow, gop), LiveStream::Wait::kGop);
  EXPECT_EQ(gop.number, 0U);
  EXPECT_EQ(stream.next(1, kNow, gop), LiveStream::Wait::kNothingYet);
  for (std::size_t i = 3; i < 3 + LiveStream::kKeptGops; ++i) stream.add(parts[i]);
  ASSERT_EQ(stream.next(1, kNow, gop), LiveStream::Wait::kGop);
  EXPECT_EQ(gop.number, 1U) << "a little late loses nothing";
  stream.add(parts[3 + LiveStream::kKeptGops]);
  ASSERT_EQ(stream.next(1, kNow, gop), LiveStream::Wait::kGop);
  EXPECT_EQ(gop.number, LiveStream::kKeptGops + 1) << "too late: the newest";
}

TEST(LiveHub, GopsThatNobodyHoldsAreGivenUp) {
  LiveStream stream(kRoom);
  const std::vector<StreamPart> parts = make_parts(12);
  for (std::size_t i = 0; i < 3; ++i) stream.add(parts[i]);
  LiveGop gop;
  ASSERT_EQ(stream.next(0, kNow, gop), LiveStream::Wait::kGop);
  const std::weak_ptr<const std::vector<std::uint8_t>> chunk = gop.chunk;
  gop = {};
  for (std::size_t i = 3; i < 3 + LiveStream::kKeptGops; ++i) stream.add(parts[i]);
  EXPECT_TRUE(chunk.expired());
}

TEST(LiveHub, LargeGopsAreKeptOneAtATime) {
  LiveStream stream(1);
  const std::vector<StreamPart> parts = make_parts(4);
  for (std::size_t i = 0; i < 6; ++i) stream.add(parts[i]);
  LiveGop gop;
  ASSERT_EQ(stream.next(2, kNow, gop), LiveStream::Wait::kGop);
  EXPECT_EQ(gop.number, 3U);
}

TEST(LiveHub, WhatASlowViewerGotIsAWholeStreamWithGapsInTheNumbers) {
  const auto stream = std::make_shared<LiveStream>(kRoom);
  const std::vector<StreamPart> parts = make_parts(12);
  for (std::size_t i = 0; i < 3; ++i) stream->add(parts[i]);
  LiveViewer viewer(stream, *stream->wait_for_start(kNow));
  std::string bytes = take_all(viewer);
  for (std::size_t i = 3; i < parts.size(); ++i) stream->add(parts[i]);
  bytes += take_all(viewer);
  const test::DecodedStream seen = decode_text(bytes);
  EXPECT_TRUE(seen.complete);
  EXPECT_TRUE(seen.damage.empty());
  ASSERT_EQ(seen.frames.size(), 4U);
  EXPECT_EQ(seen.frames[0].gop.source_frame, 0U);
  EXPECT_EQ(seen.frames[2].gop.source_frame, 22U);
}

TEST(LiveHub, WhoJoinsLateIsGivenTheMeshAndThePlanesOfTheGop) {
  const test::PlanBuffer mesh = test::some_mesh(1);
  const test::PlanBuffer plan = test::some_plan(mesh, 1), other = test::some_plan(mesh, 2);
  const test::PlanBuffer bytes = test::PlanStream(1, 2)
                                     .mesh(mesh)
                                     .plan(plan)
                                     .gop(mesh, {plan})
                                     .plan(other)
                                     .gop(mesh, {other})
                                     .gop(mesh, {plan})
                                     .end();
  const auto stream = std::make_shared<LiveStream>(kRoom);
  const std::vector<StreamPart> parts = parts_of(bytes);
  ASSERT_EQ(parts.size(), 8U);
  for (std::size_t i = 0; i < 6; ++i) stream->add(parts[i]);
  LiveViewer viewer(stream, *stream->wait_for_start(kNow));
  std::string seen = take_all(viewer);
  for (std::size_t i = 6; i < parts.size(); ++i) stream->add(parts[i]);
  seen += take_all(viewer);
  const test::PlanBuffer expected = test::PlanStream(1, 2)
                                        .mesh(mesh)
                                        .plan(other)
                                        .gop_numbered(mesh, {other}, 2)
                                        .plan(plan)
                                        .gop_numbered(mesh, {plan}, 4)
                                        .end();
  EXPECT_EQ(seen, std::string(expected.begin(), expected.end()));
}

TEST(LiveHub, WhoJoinsLateIsGivenTheDataThatTheStreamBeginsWith) {
  EncodeOptions options;
  options.data = {{"materials", std::vector<std::uint8_t>(300, 'a')}, {"extras", {1, 2}}};
  const std::vector<StreamPart> parts = parts_of(make_live_stream(3, 1, options));
  const auto watched = [&parts](std::uint64_t room) {
    const auto stream = std::make_shared<LiveStream>(room);
    for (const StreamPart& part : parts) stream->add(part);
    LiveViewer viewer(stream, *stream->wait_for_start(kNow));
    return decode_text(take_all(viewer));
  };
  const test::DecodedStream seen = watched(kRoom);
  EXPECT_TRUE(seen.complete);
  EXPECT_EQ(seen.data, options.data);
  EXPECT_TRUE(watched(1).data.empty()) << "more than may be kept";
}

TEST(LiveHub, AViewerWhoseSinkFailsIsDone) {
  const auto stream = std::make_shared<LiveStream>(kRoom);
  for (const StreamPart& part : make_parts(2)) stream->add(part);
  LiveViewer viewer(stream, *stream->wait_for_start(kNow));
  EXPECT_EQ(stream->status().viewers, 1U);
  const auto fail = [](std::span<const std::uint8_t>) {
    return Status(Error{ErrorCode::kIo, "", {}, {}, ""});
  };
  EXPECT_EQ(viewer.step(fail, kNow), LiveViewer::Step::kFailed);
}

TEST(LiveHub, AStreamWithoutAMeshStartsNobody) {
  LiveStream stream(kRoom);
  stream.add(make_parts(1)[0]);
  EXPECT_FALSE(stream.wait_for_start(kNow));
  stream.end();
  EXPECT_FALSE(stream.wait_for_start(std::chrono::seconds(10))) << "an end is not waited for";
}

}  // namespace
}  // namespace tvg::server::testing
