#include "player/playback/stream_loader.hpp"

#include "playback_toolbox.hpp"
#include "player/playback/file_input.hpp"
#include "player/playback/pipe_input.hpp"
#include "tool/tool_error.hpp"

#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <new>
#include <random>

namespace tvg::test {
namespace {

using player::LoaderSnapshot;
using player::StreamLoader;
using testing::HasSubstr;

/// Bytes that come through a pipe.
class PipedStream {
 public:
  explicit PipedStream(Stream stream) : stream_(std::move(stream)) {
    EXPECT_EQ(::pipe(ends_), 0);
    writer_ = std::thread([this] {
      for (std::size_t at = 0; at < stream_.size();) {
        const ssize_t count = ::write(ends_[1], stream_.data() + at, stream_.size() - at);
        if (count <= 0) break;
        at += static_cast<std::size_t>(count);
      }
      ::close(ends_[1]);
    });
  }
  ~PipedStream() { writer_.join(); }
  PipedStream(const PipedStream&) = delete;
  PipedStream& operator=(const PipedStream&) = delete;

  std::unique_ptr<player::StreamInput> input(std::uint64_t limit = player::PipeInput::kDefaultLimit) {
    return std::make_unique<player::PipeInput>("a pipe", ends_[0], limit);
  }

 private:
  Stream stream_;
  int ends_[2] = {};
  std::thread writer_;
};

/// The stream with bytes of one GOP's frames changed.
Stream with_damage(Stream stream, std::size_t gop) {
  const DecodedStream plain = decode_stream(stream);
  std::size_t met = 0;
  for (const IndexEntry& entry : plain.index) {
    if (entry.kind != IndexEntry::Kind::kGop || met++ != gop) continue;
    const std::size_t at = static_cast<std::size_t>(entry.offset) + 400;
    for (std::size_t i = 0; i < 8; ++i) stream[at + i] ^= 0x5A;
  }
  return stream;
}

TEST(StreamLoader, EveryConformanceStreamGivesTheFramesOfAPlainDecoder) {
  int streams = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TVG_CONFORMANCE_STREAMS)) {
    if (entry.path().extension() != ".tvg") continue;
    SCOPED_TRACE(entry.path().filename());
    std::ifstream file(entry.path(), std::ios::binary);
    const Stream bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    StreamLoader loader(player::open_stream_input(entry.path().string()));
    for (const DecodedFrame& frame : decode_stream(bytes).frames) expect_frame(loader, frame);
    ++streams;
  }
  EXPECT_GE(streams, 15);
}

TEST(StreamLoader, SaysWhatIsKnownOfAStream) {
  const TemporaryFile file(encoded("toy", 5));
  StreamLoader loader(player::open_stream_input(file.path()));
  await_frame(loader, 11);
  ASSERT_TRUE(eventually([&] { return loader.snapshot().has_index; }));
  const LoaderSnapshot snapshot = loader.snapshot();
  EXPECT_EQ(snapshot.frame_count, 12u);
  EXPECT_EQ(snapshot.metadata.at("fps"), "25");
  ASSERT_EQ(snapshot.gops->size(), 3u);
  EXPECT_EQ((*snapshot.gops)[2].first_frame, 10u);
  EXPECT_EQ((*snapshot.gops)[2].frame_count, 2u);
  EXPECT_EQ(snapshot.buffered, (std::vector<player::FrameRun>{{0, 12}}));
  EXPECT_EQ(snapshot.decoded, (std::vector<player::FrameRun>{{0, 12}}));
  EXPECT_EQ(loader.frame_bytes(3, 6).size(), 4u);
  EXPECT_GT(loader.frame_bytes(3, 3).at(0).bytes, 0u);
}

TEST(StreamLoader, SeeksAnywhereGiveTheRightFrameWithAnIndexAndWithout) {
  const Stream stream = encoded("cloth", 3);
  const DecodedStream plain = decode_stream(stream);
  const TemporaryFile file(stream);
  PipedStream pipe(stream);
  StreamLoader from_file(player::open_stream_input(file.path()), {.ring_frames = 2});
  StreamLoader from_pipe(pipe.input(), {.ring_frames = 2});
  std::mt19937 random(7);
  for (int i = 0; i < 60; ++i) {
    const DecodedFrame& frame = plain.frames[random() % plain.frames.size()];
    for (StreamLoader* loader : {&from_file, &from_pipe}) {
      loader->seek(frame.number, i % 3);
      ASSERT_NO_FATAL_FAILURE(expect_frame(*loader, frame));
    }
  }
}

/// An input that notes what is read of it.
class NotedInput final : public player::StreamInput {
 public:
  using Notes = std::shared_ptr<std::vector<ByteRange>>;

  NotedInput(std::unique_ptr<player::StreamInput> input, Notes notes)
      : input_(std::move(input)), notes_(std::move(notes)) {}

  const std::string& name() const override { return input_->name(); }
  std::optional<std::uint64_t> size() const override { return input_->size(); }
  Result<std::size_t> read(std::uint64_t offset, std::span<std::uint8_t> target) override {
    Result<std::size_t> count = input_->read(offset, target);
    if (count) notes_->push_back({offset, *count});
    return count;
  }
  Result<std::vector<std::uint8_t>> read_aside(const ByteRange& range) override {
    return input_->read_aside(range);
  }
  bool reaches(std::uint64_t offset) const override { return input_->reaches(offset); }
  void interrupt() override { input_->interrupt(); }
  void resume() override { input_->resume(); }
  void cancel() override { input_->cancel(); }
  std::vector<ByteRange> buffered() const override { return input_->buffered(); }
  player::InputStatus status() const override { return input_->status(); }

 private:
  std::unique_ptr<player::StreamInput> input_;
  Notes notes_;
};

TEST(StreamLoader, ASeekInABasisReadsItsPlanesAndItsGopAndNotTheRest) {
  constexpr std::uint64_t kPiece = 1 << 16;
  const Stream& stream = basis_of_noise();
  const DecodedStream plain = decode_stream(stream);
  const std::uint64_t plan = last_of(plain.index, IndexEntry::Kind::kPlan);
  const std::uint64_t gop = last_of(plain.index, IndexEntry::Kind::kGop);
  ASSERT_GT(plan, 3 * kPiece);
  ASSERT_GT(gop - plan, kPiece / 2);
  const TemporaryFile file(stream);
  const auto notes = std::make_shared<std::vector<ByteRange>>();
  {
    StreamLoader loader(std::make_unique<NotedInput>(player::open_stream_input(file.path()), notes),
                        {.ring_frames = 2});
    ASSERT_NO_FATAL_FAILURE(expect_frame(loader, plain.frames[0]));
    loader.seek(62);
    ASSERT_NO_FATAL_FAILURE(expect_frame(loader, plain.frames[62]));
    // Both GOPs are of the period whose planes are there.
    loader.seek(50);
    ASSERT_NO_FATAL_FAILURE(expect_frame(loader, plain.frames[50]));
  }
  std::size_t first = 0;
  while (first < notes->size() && (*notes)[first].offset < plan) ++first;
  ASSERT_LT(first, notes->size());
  EXPECT_EQ((*notes)[first].offset, plan);
  std::uint64_t before = 0, of_planes = 0;
  for (std::size_t i = 0; i < notes->size(); ++i) {
    if (i < first) before += (*notes)[i].size;
    if (i >= first) {
      EXPECT_GE((*notes)[i].offset, plan);
    }
    of_planes += (*notes)[i].offset == plan ? 1 : 0;
  }
  EXPECT_LT(before, plan - kPiece) << "periods between were read";
  EXPECT_EQ(of_planes, 1u);
}

TEST(StreamLoader, SeeksInQuickSuccessionEndAtTheLastOne) {
  const Stream stream = encoded("toy", 4);
  const DecodedStream plain = decode_stream(stream);
  const TemporaryFile file(stream);
  StreamLoader loader(player::open_stream_input(file.path()), {.ring_frames = 2});
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 10; ++i) loader.seek(random() % 12);
    const std::uint64_t last = random() % 12;
    loader.seek(last);
    EXPECT_TRUE(loader.heads_for(last) || loader.show(last));
    ASSERT_NO_FATAL_FAILURE(expect_frame(loader, plain.frames[last]));
  }
}

TEST(StreamLoader, ADamagedGopIsHeldAndMarked) {
  const Stream stream = encoded("cloth", 3);
  const Stream damaged = with_damage(stream, 1);
  const DecodedStream plain = decode_stream(damaged);
  ASSERT_FALSE(plain.damage.empty());
  ASSERT_LT(plain.frames.size(), decode_stream(stream).frames.size());
  const TemporaryFile file(damaged);
  StreamLoader loader(player::open_stream_input(file.path()));
  std::size_t next = 0;
  const std::uint64_t count = decode_stream(stream).frames.size();
  for (std::uint64_t number = 0; number < count; ++number) {
    if (next < plain.frames.size() && plain.frames[next].number == number) ++next;
    const auto frame = await_frame(loader, number);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->number, plain.frames[next - 1].number) << "the last good one";
    EXPECT_EQ(frame->positions, plain.frames[next - 1].positions);
  }
  const LoaderSnapshot snapshot = loader.snapshot();
  ASSERT_EQ(snapshot.damage.size(), 1u);
  EXPECT_EQ(snapshot.damage[0].frames.first, plain.damage[0].first_frame);
  EXPECT_EQ(snapshot.damage[0].frames.count, plain.damage[0].frame_count);
  loader.seek(plain.damage[0].first_frame);
  EXPECT_TRUE(await_frame(loader, plain.damage[0].first_frame));
}

TEST(StreamLoader, MemoryIsBoundedByTheRing) {
  const TemporaryFile file(encoded("toy", 5));
  StreamLoader loader(player::open_stream_input(file.path()), {.ring_frames = 4});
  loader.set_loop(player::LoopRange{});
  for (int round = 0; round < 10; ++round) {
    for (std::uint64_t f = 0; f < 12; ++f) ASSERT_TRUE(await_frame(loader, f));
  }
  EXPECT_GE(loader.snapshot().frames_decoded, 100u);
  EXPECT_LE(loader.snapshot().frame_slots, 8u) << "4 in the ring and 4 outside";

  StreamLoader tight(player::open_stream_input(file.path()), {.ring_bytes = 1});
  await_frame(tight, 0);
  EXPECT_EQ(tight.snapshot().ring_capacity, 2u);
}

TEST(StreamLoader, ALoopGoesOnWithItsFirstFrame) {
  const Stream stream = encoded("toy", 5);
  const DecodedStream plain = decode_stream(stream);
  const TemporaryFile file(stream);
  StreamLoader loader(player::open_stream_input(file.path()), {.ring_frames = 4});
  loader.set_loop(player::LoopRange{3, 8});
  loader.seek(3);
  for (int round = 0; round < 3; ++round) {
    for (std::uint64_t f = 3; f <= 8; ++f) ASSERT_NO_FATAL_FAILURE(expect_frame(loader, plain.frames[f]));
  }
  loader.set_loop(std::nullopt);
  loader.seek(9);
  for (std::uint64_t f = 9; f < 12; ++f) ASSERT_NO_FATAL_FAILURE(expect_frame(loader, plain.frames[f]));
  ASSERT_TRUE(eventually([&] { return loader.snapshot().state == LoaderSnapshot::State::kEnded; }));
  loader.set_loop(player::LoopRange{});
  expect_frame(loader, plain.frames[0]);
}

TEST(StreamLoader, AStreamThatIsCutShowsWhatIsThereAndSaysWhy) {
  Stream stream = encoded("toy", 5);
  const DecodedStream plain = decode_stream(stream);
  stream.resize(static_cast<std::size_t>(plain.index[2].offset) + 300);
  const TemporaryFile file(stream);
  StreamLoader loader(player::open_stream_input(file.path()));
  for (std::uint64_t f = 0; f < 5; ++f) expect_frame(loader, plain.frames[f]);
  ASSERT_TRUE(eventually([&] { return loader.supply().failed; }));
  EXPECT_THAT(loader.snapshot().message, HasSubstr(file.path()));
  EXPECT_THAT(loader.snapshot().message, HasSubstr("ends before it is complete"));
  EXPECT_TRUE(loader.show(2));
  loader.seek(100);
  ASSERT_TRUE(eventually([&] { return loader.supply().failed; }));
  loader.seek(1);
  expect_frame(loader, plain.frames[1]);
}

TEST(StreamLoader, WhatIsNoStreamFailsWithItsName) {
  const TemporaryFile file(Stream(1000, 'x'));
  StreamLoader loader(player::open_stream_input(file.path()));
  ASSERT_TRUE(eventually([&] { return loader.supply().failed; }));
  EXPECT_THAT(loader.snapshot().message, HasSubstr(file.path()));
  EXPECT_THAT(loader.snapshot().message, HasSubstr("not a TVG stream"));
  EXPECT_THROW(player::open_stream_input("/no/such/file.tvg"), cli::ToolError);
  EXPECT_THROW(player::open_stream_input("/"), cli::ToolError);
}

TEST(StreamLoader, APipeThatIsSilentDoesNotHoldUpTheEnd) {
  int ends[2] = {};
  ASSERT_EQ(::pipe(ends), 0);
  {
    StreamLoader loader(std::make_unique<player::PipeInput>("a pipe", ends[0]));
    EXPECT_EQ(loader.show(0), nullptr);
    loader.seek(5);
  }
  ::close(ends[1]);
}

/// A stream whose reading finds no memory from the given byte on.
class ScarceInput final : public player::PipeInput {
 public:
  ScarceInput(int descriptor, std::uint64_t enough) : PipeInput("scarce", descriptor), enough_(enough) {}
  Result<std::size_t> read(std::uint64_t offset, std::span<std::uint8_t> target) override {
    if (offset >= enough_) throw std::bad_alloc();
    return PipeInput::read(offset, target.first(std::min<std::size_t>(target.size(), 100)));
  }

 private:
  std::uint64_t enough_;
};

TEST(StreamLoader, AnAllocationThatFailsIsAMessageAndWhatIsDecodedCanBeShown) {
  const Stream stream = encoded("toy", 5);
  const DecodedStream plain = decode_stream(stream);
  for (const std::uint64_t enough : {std::uint64_t{0}, plain.index[2].offset}) {
    const TemporaryFile file(stream);
    StreamLoader loader(std::make_unique<ScarceInput>(::open(file.path().c_str(), O_RDONLY), enough));
    ASSERT_TRUE(eventually([&] { return loader.supply().failed; }));
    EXPECT_THAT(loader.snapshot().message, HasSubstr("not enough memory"));
    if (enough > 0) expect_frame(loader, plain.frames[0]);
  }
}

TEST(FramePool, TellsWhenAFrameIsLetGoAlsoAfterThePoolHasGone) {
  const auto bell = std::make_shared<player::Bell>();
  std::shared_ptr<player::PlayerFrame> kept;
  {
    player::FramePool pool(bell);
    pool.set_limit(2);
    std::shared_ptr<player::PlayerFrame> first = pool.take();
    kept = pool.take();
    ASSERT_TRUE(first && kept);
    EXPECT_FALSE(pool.has_free());
    EXPECT_EQ(pool.take(), nullptr);
    const player::PlayerFrame* const used = first.get();
    std::shared_ptr<const player::PlayerFrame> shown = std::move(first);
    const std::uint32_t before = bell->strokes();
    std::thread([&] { shown.reset(); }).join();
    EXPECT_EQ(bell->strokes(), before + 1);
    EXPECT_TRUE(pool.has_free());
    EXPECT_EQ(pool.take().get(), used);
    EXPECT_EQ(pool.size(), 2u);
    pool.drop_free();
    EXPECT_EQ(pool.size(), 1u);
  }
  kept.reset();
}

TEST(PipeInput, GoesBackAsFarAsItKeepsBytes) {
  Stream bytes(300'000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i / 1000);
  PipedStream pipe(bytes);
  const auto input = pipe.input(100'000);
  std::vector<std::uint8_t> piece(1000);
  for (std::size_t at = 0; at < bytes.size();) {
    const Result<std::size_t> count = input->read(at, piece);
    ASSERT_TRUE(count);
    ASSERT_EQ(piece[0], bytes[at]);
    at += *count;
  }
  ASSERT_TRUE(input->read(bytes.size() - 40'000, piece));
  EXPECT_EQ(piece[0], bytes[bytes.size() - 40'000]);
  const Result<std::size_t> gone = input->read(0, piece);
  ASSERT_FALSE(gone);
  EXPECT_THAT(gone.error().message, HasSubstr("a pipe: cannot go back to byte 0"));
  EXPECT_FALSE(input->reaches(0));
}

/// Gives each vertex the number of its frame.
class NumberDecorator final : public player::FrameDecorator {
 public:
  explicit NumberDecorator(float sign) : sign_(sign) {}
  void on_gop(const Mesh& mesh, const player::PlayerGop&) override { vertices_ = mesh.vertex_count; }
  void on_frame(player::PlayerFrame& frame) override {
    frame.values.assign(vertices_, sign_ * static_cast<float>(frame.number));
  }

 private:
  float sign_;
  std::size_t vertices_ = 0;
};

TEST(StreamLoader, ADecoratorFillsValuesOfEveryFrameFromTheOneShownOn) {
  const TemporaryFile file(encoded("toy", 5));
  StreamLoader loader(player::open_stream_input(file.path()));
  EXPECT_TRUE(await_frame(loader, 3)->values.empty());
  for (const float sign : {1.0f, -1.0f}) {
    loader.set_decorator(std::make_shared<NumberDecorator>(sign), 3);
    for (std::uint64_t f = 3; f < 12; ++f) {
      const auto frame = await_frame(loader, f);
      ASSERT_EQ(frame->values.size(), frame->mesh->vertex_count);
      EXPECT_EQ(frame->values[0], sign * static_cast<float>(f));
    }
  }
  loader.set_decorator(nullptr, 5);
  EXPECT_TRUE(await_frame(loader, 5)->values.empty());
}

TEST(FramesOfBytes, CountsWhatReachesFromAGopsStart) {
  const std::vector<player::GopMark> marks = {{0, 10, 100, 50}, {10, 10, 150, 50}, {20, 10, 200, 100}};
  using Runs = std::vector<player::FrameRun>;
  EXPECT_EQ(player::frames_of_bytes(marks, {{0, 300}}), (Runs{{0, 30}}));
  EXPECT_EQ(player::frames_of_bytes(marks, {{0, 175}}), (Runs{{0, 15}}));
  EXPECT_EQ(player::frames_of_bytes(marks, {{0, 120}, {150, 30}, {201, 99}}), (Runs{{0, 4}, {10, 6}}));
  EXPECT_EQ(player::frames_of_bytes(marks, {}), Runs{});
  EXPECT_EQ(player::frames_of_bytes({}, {{0, 300}}), Runs{});
}

}  // namespace
}  // namespace tvg::test
