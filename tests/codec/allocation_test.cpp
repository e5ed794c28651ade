#include "codec_toolbox.hpp"
#include "container/chunk.hpp"
#include "container/head.hpp"
#include "corpus/corpus.hpp"

#include <atomic>
#include <cstdlib>
#include <gtest/gtest.h>
#include <new>
#include <vector>

namespace {

std::atomic<std::size_t> allocations{0};
std::atomic<std::size_t> allocated_bytes{0};

void* counted(std::size_t size) noexcept {
  ++allocations;
  allocated_bytes += size;
  return std::malloc(size == 0 ? 1 : size);
}

void* counted_or_throw(std::size_t size) {
  if (void* const memory = counted(size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

// All of this program's allocations are counted.
void* operator new(std::size_t size) {
  return counted_or_throw(size);
}
void* operator new[](std::size_t size) {
  return counted_or_throw(size);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return counted(size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return counted(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, const std::nothrow_t&) noexcept {
  std::free(memory);
}

namespace tvg::test {
namespace {

/// Allocations between the start of a GOP and its last frame, over a whole stream pushed in 4 KiB pieces.
std::size_t allocations_in_frame_loop(const Stream& stream) {
  Decoder decoder;
  std::vector<float> positions;
  std::size_t at = 0, counted_here = 0, frames_left = 0, frames = 0;
  for (;;) {
    const std::size_t before = allocations;
    const Decoder::Event event = decoder.poll();
    if (event == Decoder::Event::kFrame) decoder.copy_positions(positions.data());
    if (event == Decoder::Event::kNeedBytes) {
      const std::size_t size = std::min<std::size_t>(4096, stream.size() - at);
      if (size == 0) decoder.finish();
      decoder.push(std::span(stream).subspan(at, size));
      at += size;
    }
    if (frames_left > 0) counted_here += allocations - before;
    if (event == Decoder::Event::kMesh) positions.resize(3 * std::size_t{decoder.mesh().vertex_count});
    if (event == Decoder::Event::kGop) frames_left = decoder.gop().frame_count;
    if (event == Decoder::Event::kFrame) --frames_left, ++frames;
    if (event == Decoder::Event::kEnd || event == Decoder::Event::kError) break;
  }
  EXPECT_GT(frames, 0u);
  return counted_here;
}

TEST(Allocation, FrameLoopMakesNoneOnceAGopHasBegun) {
  for (const char* const name : {"hand", "cloth", "soup"}) {
    const Sequence sequence = corpus::find_corpus_entry(name)->make({1600, 24}).sequence;
    for (const auto& [fine, coarse] : {std::pair(11, 11), std::pair(13, 11), std::pair(16, 16)}) {
      EncodeOptions options;
      options.fine_bits = fine;
      options.coarse_bits = coarse;
      options.gop_frames = 8;
      for (const Predictor predictor : {Predictor::kElp, Predictor::kPyramid}) {
        options.predictor = predictor;
        EXPECT_EQ(allocations_in_frame_loop(encode_sequence(sequence, options)), 0u) << name << ' ' << fine;
      }
    }
  }
}

TEST(Allocation, FrameLoopMakesNoneWithoutLoss) {
  EncodeOptions options;
  options.mode = Mode::kLossless;
  options.gop_frames = 8;
  for (const char* const name : {"hand", "soup"}) {
    const Sequence sequence = corpus::find_corpus_entry(name)->make({1600, 24}).sequence;
    EXPECT_EQ(allocations_in_frame_loop(encode_sequence(sequence, options)), 0u) << name;
  }
}

TEST(Allocation, FrameLoopMakesNoneForNoiseOn24Bits) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> anywhere(0, 1);
  Sequence sequence{grid(40, 40), {}, {}};
  for (int f = 0; f < 8; ++f) {
    sequence.frames.emplace_back(3 * std::size_t{sequence.mesh.vertex_count});
    for (float& x : sequence.frames.back()) x = anywhere(random);
  }
  EncodeOptions options;
  options.fine_bits = options.coarse_bits = 24;
  EXPECT_EQ(allocations_in_frame_loop(encode_sequence(sequence, options)), 0u);
}

TEST(Allocation, AStreamAboveTheLimitsIsRefusedBeforeMemoryIsTaken) {
  StreamLimits limits{0x7FFFFFFF, 0x7FFFFFFF, 65536, 0x7FFFFFFF, 65536, 0x7FFFFFFF, 0};
  limits.decoder_memory = decoder_memory_needed(limits);
  Stream stream(kSignature.begin(), kSignature.end());
  const Stream head = write_chunk(kHeadChunk, false, write_head(limits));
  stream.insert(stream.end(), head.begin(), head.end());
  const std::size_t before = allocated_bytes;
  const DecodedStream back = decode_stream(stream);
  EXPECT_EQ(back.error.code, ErrorCode::kLimitExceeded);
  EXPECT_LT(allocated_bytes - before, 100000u);
}

TEST(Allocation, DeclaredLimitsAloneTakeNoMemory) {
  StreamLimits limits{1u << 24, 1u << 24, 65536, 1u << 28, 65536, 1u << 28, 0};
  limits.decoder_memory = decoder_memory_needed(limits);
  Stream stream(kSignature.begin(), kSignature.end());
  const Stream head = write_chunk(kHeadChunk, false, write_head(limits));
  stream.insert(stream.end(), head.begin(), head.end());
  DecoderLimits generous;
  generous.memory = limits.decoder_memory;
  const std::size_t before = allocated_bytes;
  EXPECT_EQ(decode_stream(stream, generous).error.code, ErrorCode::kTruncated);
  EXPECT_LT(allocated_bytes - before, 100000u);
}

}  // namespace
}  // namespace tvg::test
