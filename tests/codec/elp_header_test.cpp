#include "modes/elp_header.hpp"

#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace tvg {
namespace {

using Buffer = std::vector<std::uint8_t>;

Lattice some_lattice() {
  return {.origin = {-1.5, 0, 2}, .step = 0.125, .fine_bits = 13, .coarse_bits = 11};
}

PredictorSet all_predictors() {
  return PredictorSet(15);
}

/// What the mode has behind the channels, with positions as the only one before it.
Buffer with_positions(Bytes fields) {
  ByteWriter writer;
  write_channels(writer, {});
  writer.bytes(fields);
  return writer.take();
}

Result<ElpHeader> read(Bytes fields) {
  GopHeader header;
  header.fields = fields;
  ElpHeader elp;
  const Status status = read_elp_header(header, elp);
  return status.ok() ? Result<ElpHeader>(elp) : Result<ElpHeader>(status.error());
}

/// The fields of a header with these channels and everything else in order.
Buffer with_channels(const std::vector<std::uint64_t>& channels) {
  ByteWriter writer;
  writer.varint(channels.size());
  for (const std::uint64_t channel : channels) writer.varint(channel);
  writer.bytes(write_elp_header(all_predictors(), some_lattice(), {}));
  return writer.take();
}

TEST(ElpHeader, ComesBack) {
  const Buffer flags = {8, 9};
  const Buffer fields = with_positions(write_elp_header(all_predictors(), some_lattice(), flags));
  const Result<ElpHeader> back = read(fields);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->lattice, some_lattice());
  EXPECT_EQ(back->channels.count, 1u);
  EXPECT_EQ(Buffer(back->flags.begin(), back->flags.end()), flags);
  for (std::size_t length = 0; length + flags.size() < fields.size(); ++length)
    EXPECT_FALSE(read(Bytes(fields).first(length))) << length;
}

TEST(ElpHeader, EveryFieldOutOfRangeIsRefused) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<const char*, std::function<void(Lattice&)>>> faults = {
      {"no bits", [](Lattice& l) { l.fine_bits = l.coarse_bits = 0; }},
      {"coarse 0", [](Lattice& l) { l.coarse_bits = 0; }},
      {"25 bits", [](Lattice& l) { l.fine_bits = 25; }},
      {"coarse above fine", [](Lattice& l) { l.coarse_bits = 14; }},
      {"origin", [](Lattice& l) { l.origin[2] = kInf; }},
      {"origin nan", [](Lattice& l) { l.origin[0] = kNan; }},
      {"step 0", [](Lattice& l) { l.step = 0; }},
      {"step below 0", [](Lattice& l) { l.step = -1; }},
      {"step nan", [](Lattice& l) { l.step = kNan; }},
      {"step infinite", [](Lattice& l) { l.step = kInf; }},
  };
  for (const auto& [name, fault] : faults) {
    Lattice lattice = some_lattice();
    fault(lattice);
    const Result<ElpHeader> refused = read(with_positions(write_elp_header(all_predictors(), lattice, {})));
    ASSERT_FALSE(refused) << name;
    EXPECT_EQ(refused.error().code, ErrorCode::kMalformed) << name;
  }
  Lattice one = some_lattice();
  one.coarse_bits = one.fine_bits;
  EXPECT_FALSE(read(with_positions(write_elp_header(all_predictors(), one, Buffer{0}))))
      << "flags of one lattice";
}

TEST(ElpHeader, PredictorsThatAreNotKnownAreUnsupportedAndOneIsForTheFirstFrame) {
  const auto code = [](std::uint8_t predictors) {
    const Result<ElpHeader> header =
        read(with_positions(write_elp_header(PredictorSet(predictors), some_lattice(), {})));
    return header ? ErrorCode::kIo : header.error().code;
  };
  EXPECT_EQ(code(0x10), ErrorCode::kUnsupported);
  EXPECT_EQ(code(0x81), ErrorCode::kUnsupported);
  EXPECT_EQ(code(0), ErrorCode::kMalformed);
  EXPECT_EQ(code(0x06), ErrorCode::kMalformed) << "time and elp need a frame before";
  EXPECT_EQ(code(0x01), ErrorCode::kIo);
  EXPECT_EQ(code(0x08), ErrorCode::kIo);
}

TEST(ElpHeader, ChannelsThatAreNotKnownAreSkippedOrUnsupportedByTheirNumber) {
  EXPECT_TRUE(read(with_channels({1, 2, 40})));
  const auto code = [](const std::vector<std::uint64_t>& channels) {
    const Result<ElpHeader> header = read(with_channels(channels));
    return header ? ErrorCode::kIo : header.error().code;
  };
  EXPECT_EQ(code({1, 3}), ErrorCode::kUnsupported);
  EXPECT_EQ(code({2}), ErrorCode::kMalformed) << "positions come first";
  EXPECT_EQ(code({}), ErrorCode::kMalformed);
  EXPECT_EQ(code({1, 4, 4}), ErrorCode::kMalformed);
}

TEST(ElpHeader, PositionsAreTheFirstPieceOfAPacketAndTheFirstDigest) {
  Channels channels;
  const Buffer alone = {7, 8, 9};
  ASSERT_TRUE(positions_piece(channels, alone));
  EXPECT_EQ(positions_piece(channels, alone)->size(), 3u);
  channels.numbers[1] = 2;
  channels.count = 2;
  const Buffer both = {2, 7, 8, 1, 1, 1};
  const Result<Bytes> piece = positions_piece(channels, both);
  ASSERT_TRUE(piece);
  EXPECT_EQ(Buffer(piece->begin(), piece->end()), (Buffer{7, 8}));
  EXPECT_FALSE(positions_piece(channels, Buffer{9, 7, 8}));

  ByteWriter digest;
  digest.varint(1);
  digest.u64(1234);
  EXPECT_EQ(compare_digest(channels, digest.data(), 1234).error().code, ErrorCode::kMalformed)
      << "the second is missing";
  digest.varint(2);
  digest.u64(99);
  EXPECT_TRUE(compare_digest(channels, digest.data(), 1234).ok());
  EXPECT_EQ(compare_digest(channels, digest.data(), 1235).error().code, ErrorCode::kDigestMismatch);
  EXPECT_TRUE(compare_digest(Channels(), write_digest(5678, {}), 5678).ok());
}

}  // namespace
}  // namespace tvg
