#include "c_api_toolbox.hpp"
#include "tests/codec/levels_toolbox.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

// Planes and rows of mode basis, as a GPU takes them (tvg_basis.h).
namespace tvg::test {
namespace {

EncodeOptions basis_options(int fine_bits = 12, int coarse_bits = 12) {
  EncodeOptions options;
  options.mode = Mode::kBasis;
  options.fine_bits = fine_bits;
  options.coarse_bits = coarse_bits;
  options.period_frames = 6;
  options.gop_frames = 3;
  return options;
}

Sequence corpus_sequence(const char* name = "hand") {
  return corpus::find_corpus_entry(name)->make(*corpus::named_size("small")).sequence;
}

/// Its first six frames, so often, each time in other proportions.
Sequence stretched(Sequence sequence, std::size_t times) {
  sequence.frames.resize(6);
  const std::vector<FramePositions> frames = sequence.frames;
  for (std::size_t i = 1; i < times; ++i)
    sequence.frames.insert(sequence.frames.end(), frames.begin(), frames.end());
  for (std::size_t f = 0; f < sequence.frames.size(); ++f) {
    for (std::size_t i = 0; i < sequence.frames[f].size(); i += 7)
      sequence.frames[f][i] *= 1 + 0.1F * static_cast<float>(f / 6);
  }
  return sequence;
}

/// The planes of the GOP, [vertex][component], padded to whole groups.
std::vector<float> planes_of(StreamDecoder& decoder) {
  const tvg_basis_info basis = *decoder.basis();
  const std::size_t padded = (std::size_t{basis.component_count} + 3) / 4 * 4;
  std::vector<float> planes(basis.vertex_count * padded), group(4 * std::size_t{basis.vertex_count});
  for (std::uint32_t g = 0; 4 * g < padded; ++g) {
    EXPECT_EQ(decoder.copy_planes(g, group.data(), group.size()), TVG_OK);
    for (std::size_t i = 0; i < group.size(); ++i) planes[i / 4 * padded + 4 * g + i % 4] = group[i];
  }
  return planes;
}

/// The sums in float32, as a GPU makes them, are within the bound that docs/web.md states of the positions.
void expect_near(StreamDecoder& decoder, std::span<const float> planes) {
  const tvg_basis_info basis = *decoder.basis();
  std::vector<float> rows(3 * (1 + std::size_t{basis.component_count}));
  std::vector<float> positions(3 * std::size_t{basis.vertex_count});
  ASSERT_EQ(decoder.copy_rows(rows.data(), rows.size()), TVG_OK);
  ASSERT_EQ(decoder.copy_positions(positions.data(), positions.size()), TVG_OK);
  const std::size_t padded = planes.size() / basis.vertex_count;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    float sum = rows[i % 3];
    double size = std::abs(double{sum});
    for (std::size_t a = 0; a < basis.component_count; ++a) {
      const float term = planes[i / 3 * padded + a] * rows[3 * (1 + a) + i % 3];
      sum += term;
      size += std::abs(double{term});
    }
    ASSERT_LE(std::abs(double{sum} - double{positions[i]}), (basis.component_count + 4) * size * 0x1p-23);
  }
}

/// Decodes a stream and calls `use` with every frame.
void for_each_frame(StreamDecoder& decoder, const Stream& stream, const std::function<void()>& use) {
  decoder.push(stream.data(), stream.size());
  decoder.finish();
  for (tvg_event event = decoder.poll(); event != TVG_EVENT_END; event = decoder.poll()) {
    ASSERT_NE(event, TVG_EVENT_ERROR) << decoder.error_text();
    if (event == TVG_EVENT_FRAME) use();
  }
}

TEST(CBasis, SumsOfPlanesAreTheFrames) {
  EncodeOptions with_levels = basis_options();
  with_levels.levels = greedy_levels(corpus_sequence().mesh, 4, {2, 4});
  // Coefficients of fine lattices may not fit 16 bits.
  for (const EncodeOptions& options :
       {basis_options(), basis_options(12, 8), basis_options(16, 16), with_levels}) {
    const Stream stream = encode_sequence(corpus_sequence(), options);
    for (const std::uint32_t lod : {0u, 1u}) {
      for (const std::uint32_t components : {kMaxComponents, 5u}) {
        StreamDecoder decoder;
        decoder.use_lod(lod);
        decoder.use_components(components);
        std::size_t frames = 0;
        for_each_frame(decoder, stream, [&] {
          ++frames;
          EXPECT_LE(decoder.basis()->component_count, std::max(components, 8u));
          expect_near(decoder, planes_of(decoder));
        });
        EXPECT_EQ(frames, 12u);
      }
    }
  }
}

TEST(CBasis, ShortPlanesAreTheSameWhereTheyFit) {
  for (const int bits : {12, 16}) {
    StreamDecoder decoder;
    for_each_frame(decoder, encode_sequence(corpus_sequence(), basis_options(bits, bits)), [&] {
      const tvg_basis_info basis = *decoder.basis();
      std::vector<float> floats(4 * std::size_t{basis.vertex_count});
      std::vector<std::int16_t> shorts(floats.size());
      float most = 0;
      for (std::uint32_t group = 0; 4 * group < basis.component_count; ++group) {
        ASSERT_EQ(decoder.copy_planes(group, floats.data(), floats.size()), TVG_OK);
        for (const float value : floats) most = std::max(most, std::abs(value));
        const tvg_code code = decoder.copy_short_planes(group, shorts.data(), shorts.size());
        ASSERT_EQ(code, basis.most <= 32767 ? TVG_OK : TVG_ERROR_INVALID_ARGUMENT);
        EXPECT_TRUE(code != TVG_OK || std::equal(shorts.begin(), shorts.end(), floats.begin()));
      }
      EXPECT_EQ(most, static_cast<float>(basis.most));
      EXPECT_EQ(most > 32767, bits == 16);
    });
  }
}

TEST(CBasis, PlanesHaveTheSameNumberThroughTheirPeriodAndNoOthersHaveIt) {
  const Sequence sequence = stretched(corpus_sequence(), 3);
  const Stream stream = encode_sequence(sequence, basis_options());
  StreamDecoder decoder;
  std::vector<std::uint64_t> numbers;
  for_each_frame(decoder, stream, [&] { numbers.push_back(decoder.basis()->number); });
  ASSERT_EQ(numbers.size(), 18u);
  for (std::size_t f = 0; f < numbers.size(); ++f) EXPECT_EQ(numbers[f], 1 + f / 6) << f;
  const auto number_of = [&](std::uint64_t frame) {
    const std::size_t offset = static_cast<std::size_t>(decoder.seek(frame).value());
    EXPECT_FALSE(decoder.basis());
    decoder.push(stream.data() + offset, stream.size() - offset);
    while (decoder.poll() != TVG_EVENT_FRAME) {
    }
    return decoder.basis()->number;
  };
  EXPECT_EQ(number_of(13), 3u) << "these are still there";
  EXPECT_EQ(number_of(4), 4u) << "these are not";
  EXPECT_EQ(number_of(0), 4u);
}

TEST(CBasis, OtherModesHaveNone) {
  StreamDecoder decoder;
  std::vector<float> room(1 << 16);
  for_each_frame(decoder, hybrid_stream(), [&] {
    EXPECT_FALSE(decoder.basis());
    EXPECT_EQ(decoder.copy_planes(0, room.data(), room.size()), TVG_ERROR_WRONG_STATE);
    EXPECT_EQ(decoder.copy_rows(room.data(), room.size()), TVG_ERROR_WRONG_STATE);
  });
}

TEST(CBasis, WhatDoesNotFitIsRefused) {
  const Stream stream = encode_sequence(corpus_sequence(), basis_options());
  StreamDecoder decoder;
  std::vector<float> room(1 << 16);
  std::vector<std::int16_t> shorts(1 << 16);
  EXPECT_EQ(decoder.copy_planes(0, room.data(), room.size()), TVG_ERROR_WRONG_STATE);
  decoder.push(stream.data(), stream.size());
  while (decoder.poll() != TVG_EVENT_GOP) {
  }
  const tvg_basis_info basis = *decoder.basis();
  const std::size_t coefficients = 4 * std::size_t{basis.vertex_count},
                    rows = 3 * (1 + basis.component_count);
  EXPECT_EQ(decoder.copy_planes(0, room.data(), coefficients), TVG_OK);
  EXPECT_EQ(decoder.copy_rows(room.data(), rows), TVG_ERROR_WRONG_STATE) << "there is no frame yet";
  EXPECT_EQ(decoder.copy_planes(0, room.data(), coefficients - 1), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(decoder.copy_planes(0, nullptr, coefficients), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(decoder.copy_short_planes(0, shorts.data(), coefficients - 1), TVG_ERROR_INVALID_ARGUMENT);
  for (const std::uint32_t group : {(basis.component_count + 3) / 4, 0x40000000u, 0xFFFFFFFFu})
    EXPECT_EQ(decoder.copy_planes(group, room.data(), room.size()), TVG_ERROR_INVALID_ARGUMENT);
  while (decoder.poll() != TVG_EVENT_FRAME) {
  }
  EXPECT_EQ(decoder.copy_rows(room.data(), rows), TVG_OK);
  EXPECT_EQ(decoder.copy_rows(room.data(), rows - 1), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(decoder.copy_rows(nullptr, rows), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_get_basis(nullptr, nullptr), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_get_basis(decoder.get(), nullptr), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_copy_planes(nullptr, 0, nullptr, 0), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_copy_short_planes(nullptr, 0, nullptr, 0), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_copy_rows(nullptr, nullptr, 0), TVG_ERROR_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace tvg::test
