#pragma once
#include "corpus/corpus.hpp"
#include "tests/codec/codec_toolbox.hpp"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

#include <tvg/stream_decoder.hpp>

// Streams for the C interface, and what they should decode to.
namespace tvg::test {

inline Stream hybrid_stream(const char* name = "toy") {
  EncodeOptions options;
  options.fine_bits = 12;
  options.coarse_bits = 9;
  options.gop_frames = 5;
  options.metadata = {{"fps", "25"}, {"name", "toy"}};
  return encode_sequence(corpus::find_corpus_entry(name)->make(*corpus::named_size("small")).sequence,
                         options);
}

struct CFrame {
  std::vector<float> positions, normals;  ///< [vertex][xyz]
  std::vector<std::uint8_t> flags;

  bool operator==(const CFrame&) const = default;
};

inline CFrame current_c_frame(StreamDecoder& decoder) {
  const std::size_t count = decoder.mesh()->vertex_count;
  CFrame frame{std::vector<float>(3 * count), std::vector<float>(3 * count),
               std::vector<std::uint8_t>(count)};
  EXPECT_EQ(decoder.copy_positions(frame.positions.data(), 3 * count), TVG_OK);
  EXPECT_EQ(decoder.compute_normals(frame.normals.data(), 3 * count), TVG_OK);
  EXPECT_EQ(decoder.copy_flags(frame.flags.data(), count), TVG_OK);
  return frame;
}

/// Polls until bytes are needed or nothing more comes; frames go to `frames` by their number.
inline tvg_event drain(StreamDecoder& decoder, std::map<std::uint64_t, CFrame>& frames) {
  for (;;) {
    const tvg_event event = decoder.poll();
    if (event == TVG_EVENT_FRAME) frames.insert_or_assign(decoder.frame()->number, current_c_frame(decoder));
    if (event == TVG_EVENT_NEED_BYTES || event == TVG_EVENT_END || event == TVG_EVENT_ERROR) return event;
  }
}

inline std::map<std::uint64_t, CFrame> decode_all(const Stream& stream, std::size_t piece) {
  StreamDecoder decoder;
  std::map<std::uint64_t, CFrame> frames;
  for (std::size_t at = 0; at < stream.size(); at += piece) {
    EXPECT_EQ(decoder.push(stream.data() + at, std::min(piece, stream.size() - at)), TVG_OK);
    EXPECT_EQ(drain(decoder, frames), TVG_EVENT_NEED_BYTES);
  }
  decoder.finish();
  EXPECT_EQ(drain(decoder, frames), TVG_EVENT_END) << decoder.error_text();
  return frames;
}

}  // namespace tvg::test
