#pragma once
#include "corpus/corpus.hpp"
#include "player/playback/stream_loader.hpp"
#include "tests/codec/codec_toolbox.hpp"

#include <chrono>
#include <cstdlib>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <string_view>
#include <thread>
#include <unistd.h>

namespace tvg::test {

/// A small corpus sequence as a stream.
inline Stream encoded(std::string_view name, std::uint32_t gop_frames, std::string_view size = "small") {
  EncodeOptions options;
  options.fine_bits = 12;
  options.coarse_bits = 9;
  options.gop_frames = gop_frames;
  options.metadata = {{"fps", "25"}, {"name", std::string(name)}};
  return encode_sequence(corpus::find_corpus_entry(name)->make(*corpus::named_size(size)).sequence, options);
}

/// A stream in mode basis of four periods of 16 frames, each of about 100 kB and four GOPs.
inline const Stream& basis_of_noise() {
  static const Stream kStream = [] {
    std::mt19937 random(4);
    EncodeOptions options;
    options.mode = Mode::kBasis;
    options.fine_bits = options.coarse_bits = 12;
    options.period_frames = 16;
    options.gop_frames = 4;
    options.effort = 1;
    return encode_sequence(random_sequence(grid(40, 40), 64, random), options);
  }();
  return kStream;
}

/// Where the last chunk of a kind begins in an index.
inline std::uint64_t last_of(const std::vector<IndexEntry>& index, IndexEntry::Kind kind) {
  std::uint64_t offset = 0;
  for (const IndexEntry& entry : index) {
    if (entry.kind == kind) offset = entry.offset;
  }
  return offset;
}

/// A file that is gone when the test is over.
class TemporaryFile {
 public:
  explicit TemporaryFile(const Stream& bytes) {
    const int descriptor = ::mkstemp(path_.data());
    EXPECT_GE(descriptor, 0);
    EXPECT_EQ(::write(descriptor, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
    ::close(descriptor);
  }
  ~TemporaryFile() { ::unlink(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_ = testing::TempDir() + "tvg_playback_XXXXXX";
};

/// Whether `condition` comes true within a time that only a hang exceeds.
template <class Condition>
bool eventually(const Condition& condition, std::chrono::seconds bound = std::chrono::seconds(60)) {
  const auto end = std::chrono::steady_clock::now() + bound;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

/// Waits for the frame that stands at `number`.
inline std::shared_ptr<const player::PlayerFrame> await_frame(player::StreamLoader& loader,
                                                              std::uint64_t number) {
  std::shared_ptr<const player::PlayerFrame> frame;
  eventually([&] {
    frame = loader.show(number);
    return frame || loader.supply().failed;
  });
  EXPECT_TRUE(frame) << "frame " << number << ": " << loader.snapshot().message;
  return frame;
}

inline void expect_frame(player::StreamLoader& loader, const DecodedFrame& expected) {
  const auto frame = await_frame(loader, expected.number);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->number, expected.number);
  EXPECT_EQ(frame->positions, expected.positions) << "frame " << expected.number;
  EXPECT_EQ(frame->gop->flags, expected.flags) << "frame " << expected.number;
  EXPECT_EQ(frame->gop->info.first_frame, expected.gop.first_frame);
}

}  // namespace tvg::test
