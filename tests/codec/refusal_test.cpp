#include "codec_toolbox.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

namespace tvg::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

Sequence triangle() {
  const FramePositions frame = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  return {{3, {{0, 1, 2}}}, {frame, frame, frame}, {}};
}

Error refusal(const Sequence& sequence, const EncodeOptions& options = {}) {
  SequenceSource source(sequence);
  const Result<Stream> stream = try_encode(source, options);
  EXPECT_FALSE(stream);
  if (stream) return {ErrorCode::kIo, "was encoded", {}, {}, ""};
  EXPECT_FALSE(stream.error().message.empty());
  return stream.error();
}

TEST(Refusals, OptionsOutsideTheirRangeAreRefused) {
  const std::vector<std::pair<const char*, std::function<void(EncodeOptions&)>>> faults = {
      {"no bits", [](EncodeOptions& o) { o.fine_bits = o.coarse_bits = 0; }},
      {"25 bits", [](EncodeOptions& o) { o.fine_bits = 25; }},
      {"coarse 0", [](EncodeOptions& o) { o.coarse_bits = 0; }},
      {"coarse above fine", [](EncodeOptions& o) { o.coarse_bits = 12; }},
      {"step 0", [](EncodeOptions& o) { o.step = 0; }},
      {"step below 0", [](EncodeOptions& o) { o.step = -1; }},
      {"step nan", [](EncodeOptions& o) { o.step = kNan; }},
      {"step infinite", [](EncodeOptions& o) { o.step = kInf; }},
      {"coarse step infinite", [](EncodeOptions& o) { o.step = 1e308, o.coarse_bits = 1; }},
      {"step too small", [](EncodeOptions& o) { o.step = 1e-9; }},
      {"share below 0", [](EncodeOptions& o) { o.importance.share = -0.01; }},
      {"share above 1", [](EncodeOptions& o) { o.importance.share = 1.01; }},
      {"share nan", [](EncodeOptions& o) { o.importance.share = kNan; }},
      {"alpha below 0", [](EncodeOptions& o) { o.importance.curv.alpha = -0.01; }},
      {"alpha above 1", [](EncodeOptions& o) { o.importance.curv.alpha = 1.01; }},
      {"alpha nan", [](EncodeOptions& o) { o.importance.curv.alpha = kNan; }},
      {"no frames per GOP", [](EncodeOptions& o) { o.gop_frames = 0; }},
      {"too many frames per GOP", [](EncodeOptions& o) { o.gop_frames = 65537; }},
  };
  for (const auto& [name, fault] : faults) {
    SCOPED_TRACE(name);
    EncodeOptions options;
    fault(options);
    EXPECT_EQ(refusal(triangle(), options).code, ErrorCode::kInvalidArgument);
  }
}

/// A box around the origin that goes from `low` to `high` along x.
BoundingBox box_of(double low, double high) {
  BoundingBox box;
  box.extend(low, 0, 0);
  box.extend(high, 0, 0);
  return box;
}

TEST(Refusals, ABoxThatNoLatticeCanCoverIsRefused) {
  EncodeOptions options;
  for (const BoundingBox& box : {BoundingBox(), box_of(-1e308, 1e308)}) {
    options.box = box;
    EXPECT_EQ(refusal(triangle(), options).code, ErrorCode::kInvalidArgument);
  }
}

TEST(Refusals, ABoxTooSmallToBeDividedIsStillALattice) {
  EncodeOptions options;
  options.box = box_of(0, 5e-324);
  Sequence origin = triangle();
  for (FramePositions& frame : origin.frames) frame.assign(9, 0);
  const DecodedStream back = decode_stream(encode_sequence(origin, options));
  ASSERT_EQ(back.frames.size(), 3u);
  EXPECT_TRUE(back.damage.empty());
  EXPECT_NEAR(back.frames[0].positions[0], 0, 1e-6);
}

TEST(Refusals, CoordinatesThatAreNoNumbersAreRefusedWithTheirPlace) {
  for (const double bad : {kNan, kInf, -kInf}) {
    Sequence sequence = triangle();
    sequence.frames[2][4] = static_cast<float>(bad);
    const Error error = refusal(sequence);
    EXPECT_EQ(error.code, ErrorCode::kInvalidInput);
    EXPECT_EQ(error.frame, 2u);
    EXPECT_NE(error.message.find("vertex 1"), std::string::npos) << error.message;
  }
}

TEST(Refusals, MeshesThatCannotBeEncodedAreRefused) {
  EXPECT_EQ(refusal({{0, {}}, {{}}, {}}).code, ErrorCode::kInvalidInput) << "no vertices";
  Sequence sequence = triangle();
  sequence.mesh.faces[0][1] = 3;
  const Error error = refusal(sequence);
  EXPECT_EQ(error.code, ErrorCode::kInvalidInput);
  EXPECT_NE(error.message.find("face 0 refers to vertex 3"), std::string::npos) << error.message;
  sequence = triangle();
  sequence.frames.clear();
  EXPECT_EQ(refusal(sequence).code, ErrorCode::kInvalidInput) << "no frames";
  sequence = triangle();
  sequence.frames[1].push_back(0);
  EXPECT_EQ(refusal(sequence).code, ErrorCode::kInvalidInput) << "a frame of another size";
}

TEST(Refusals, MetadataThatIsNoTextIsRefused) {
  Sequence sequence = triangle();
  for (const std::string& text : {std::string("a\0b", 3), std::string("M\xFCller")}) {
    sequence.metadata = {{text, "value"}};
    EXPECT_EQ(refusal(sequence).code, ErrorCode::kInvalidArgument);
    sequence.metadata = {{"name", text}};
    EXPECT_EQ(refusal(sequence).code, ErrorCode::kInvalidArgument);
  }
}

TEST(Refusals, ErrorOfTheSinkEndsTheEncoding) {
  const Sequence sequence = triangle();
  for (int good_writes = 0; good_writes < 5; ++good_writes) {
    SequenceSource source(sequence);
    int writes = 0;
    const Result<EncodeReport> report = encode(source, {}, [&](std::span<const std::uint8_t>) -> Status {
      if (writes++ < good_writes) return {};
      return Error{ErrorCode::kIo, "the disk is full", {}, {}, ""};
    });
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().message, "the disk is full");
    EXPECT_EQ(writes, good_writes + 1) << "nothing is written after an error";
  }
}

TEST(Refusals, DecoderRefusesAStreamAboveEachOfItsLimits) {
  const Stream stream = encode_sequence(triangle(), {});
  const StreamLimits declared = decode_stream(stream).head.limits;
  const DecoderLimits exact{declared.vertices,      declared.faces,  declared.frames_per_gop,
                            declared.packet_bytes,  declared.meshes, declared.mesh_bytes,
                            declared.decoder_memory};
  EXPECT_TRUE(decode_stream(stream, exact).complete);
  const std::vector<std::function<void(DecoderLimits&)>> cuts = {
      [](DecoderLimits& l) { --l.vertices; },       [](DecoderLimits& l) { --l.faces; },
      [](DecoderLimits& l) { --l.frames_per_gop; }, [](DecoderLimits& l) { --l.packet_bytes; },
      [](DecoderLimits& l) { --l.meshes; },         [](DecoderLimits& l) { --l.mesh_bytes; },
      [](DecoderLimits& l) { --l.memory; }};
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    DecoderLimits limits = exact;
    cuts[i](limits);
    const DecodedStream back = decode_stream(stream, limits);
    EXPECT_FALSE(back.complete) << i;
    EXPECT_EQ(back.error.code, ErrorCode::kLimitExceeded) << i;
    EXPECT_TRUE(back.meshes.empty()) << i;
  }
}

TEST(Refusals, WhatIsNoStreamIsNamedAsSuch) {
  const std::string text = "v 0 0 0\nv 1 0 0\n";
  EXPECT_EQ(decode_stream(Stream(text.begin(), text.end())).error.code, ErrorCode::kNotTvg);
  EXPECT_EQ(decode_stream({}).error.code, ErrorCode::kTruncated);
  Stream stream = encode_sequence(triangle(), {});
  stream.push_back(0);
  EXPECT_FALSE(decode_stream(stream).complete) << "bytes after the end";
  stream.resize(stream.size() - 2);
  EXPECT_EQ(decode_stream(stream).error.code, ErrorCode::kTruncated);
}

}  // namespace
}  // namespace tvg::test
