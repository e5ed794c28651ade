#include "container/chunk.hpp"
#include "tests/codec/codec_toolbox.hpp"
#include "tests/conformance/streams.hpp"

#include <gmock/gmock.h>
#include <random>

#include <tvg/relay.hpp>

namespace tvg::test {
namespace {

struct Split {
  std::vector<StreamPart> parts;
  std::optional<Error> error;  ///< of next(), else of finish()
};

Split split(const Stream& stream, const std::function<std::size_t()>& next_size,
            const RelayLimits& limits = {}) {
  StreamSplitter splitter(limits);
  Split result;
  for (std::size_t at = 0; at < stream.size();) {
    const std::size_t size = std::min(next_size(), stream.size() - at);
    EXPECT_TRUE(splitter.push(std::span(stream).subspan(at, size)).ok());
    at += size;
    for (;;) {
      Result<std::optional<StreamPart>> part = splitter.next();
      if (!part) {
        result.error = part.error();
        return result;
      }
      if (!*part) break;
      result.parts.push_back(std::move(**part));
    }
  }
  if (const Status status = splitter.finish(); !status.ok()) result.error = status.error();
  return result;
}

Split split_whole(const Stream& stream, const RelayLimits& limits = {}) {
  return split(
      stream, [&stream] { return stream.size(); }, limits);
}

/// What a viewer gets who joins when parts[0, first) have gone by and leaves before parts[last].
Stream assemble(const std::vector<StreamPart>& parts, std::size_t first, std::size_t last) {
  Stream stream;
  StreamAssembler assembler([&stream](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  });
  Metadata metadata;
  const StreamPart* mesh = nullptr;
  std::vector<const StreamPart*> plans;  // of the mesh
  for (std::size_t i = 0; i < first; ++i) {
    if (parts[i].kind == StreamPart::Kind::kMetadata) metadata = parts[i].metadata;
    if (parts[i].kind == StreamPart::Kind::kPlan) plans.push_back(&parts[i]);
    if (parts[i].kind != StreamPart::Kind::kMesh) continue;
    mesh = &parts[i];
    plans.clear();
  }
  EXPECT_TRUE(assembler.begin(parts.at(0).limits, metadata).ok());
  if (mesh != nullptr) {
    EXPECT_TRUE(assembler.write_mesh(mesh->chunk).ok());
  }
  for (const StreamPart* plan : plans) EXPECT_TRUE(assembler.write_plan(plan->chunk).ok());
  for (std::size_t i = first; i < last; ++i) {
    const StreamPart& part = parts[i];
    if (part.kind == StreamPart::Kind::kMesh) {
      EXPECT_TRUE(assembler.write_mesh(part.chunk).ok());
    } else if (part.kind == StreamPart::Kind::kPlan) {
      EXPECT_TRUE(assembler.write_plan(part.chunk).ok());
    } else if (part.kind == StreamPart::Kind::kGop) {
      EXPECT_TRUE(assembler.write_gop(part.chunk, part.frame_count).ok());
    }
  }
  EXPECT_TRUE(assembler.end().ok());
  EXPECT_EQ(assembler.bytes(), stream.size());
  return stream;
}

/// Where a viewer joins who misses nothing: the first mesh.
std::size_t beginning(const std::vector<StreamPart>& parts) {
  std::size_t first = 0;
  while (parts.at(first).kind != StreamPart::Kind::kMesh) ++first;
  return first;
}

bool same_parts(const std::vector<StreamPart>& a, const std::vector<StreamPart>& b, std::size_t count) {
  return a.size() >= count && b.size() >= count &&
         std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(count), b.begin(),
                    [](const StreamPart& x, const StreamPart& y) {
                      return x.kind == y.kind && x.limits == y.limits && x.metadata == y.metadata &&
                             x.chunk == y.chunk && x.frame_count == y.frame_count &&
                             x.first_frame == y.first_frame;
                    });
}

TEST(Relay, AnyPiecesGiveTheSameParts) {
  std::mt19937 random(5);
  for (const conformance::ConformanceStream& entry : conformance::conformance_streams()) {
    const Stream stream = entry.make();
    const Split whole = split_whole(stream);
    ASSERT_FALSE(whole.error) << entry.name << ": " << whole.error->describe();
    EXPECT_EQ(whole.parts.front().kind, StreamPart::Kind::kHead);
    EXPECT_EQ(whole.parts.back().kind, StreamPart::Kind::kEnd);
    for (const std::size_t most : {1, 2, 7, 100, 1000}) {
      std::uniform_int_distribution<std::size_t> size(1, most);
      const Split pieces = split(stream, [&] { return size(random); });
      EXPECT_FALSE(pieces.error) << entry.name;
      ASSERT_EQ(pieces.parts.size(), whole.parts.size()) << entry.name;
      EXPECT_TRUE(same_parts(pieces.parts, whole.parts, whole.parts.size())) << entry.name;
    }
  }
}

TEST(Relay, SplittingAndAssemblingGivesTheSameFrames) {
  for (const conformance::ConformanceStream& entry : conformance::conformance_streams()) {
    const Stream stream = entry.make();
    const std::vector<StreamPart> parts = split_whole(stream).parts;
    const DecodedStream before = decode_stream(stream);
    const DecodedStream after = decode_stream(assemble(parts, beginning(parts), parts.size()));
    EXPECT_TRUE(after.complete) << entry.name;
    EXPECT_TRUE(after.damage.empty()) << entry.name;
    EXPECT_EQ(after.metadata, before.metadata) << entry.name;
    expect_same_frames(after, before);
  }
}

TEST(Relay, WhoJoinsAndLeavesAnywhereHasAWholeStream) {
  for (const char* name : {"gops", "two_meshes", "metadata", "basis", "lods_basis"}) {
    const Stream stream = conformance::make_stream(name);
    const std::vector<StreamPart> parts = split_whole(stream).parts;
    const DecodedStream all = decode_stream(stream);
    for (std::size_t first = 1; first < parts.size(); ++first) {
      for (std::size_t last = first; last <= parts.size(); ++last) {
        const DecodedStream seen = decode_stream(assemble(parts, first, last));
        EXPECT_TRUE(seen.complete) << name;
        EXPECT_TRUE(seen.damage.empty()) << name;
        std::size_t at = 0;
        for (std::size_t i = 0; i < first; ++i) at += parts[i].frame_count;
        for (const DecodedFrame& frame : seen.frames) {
          ASSERT_LT(at, all.frames.size());
          EXPECT_EQ(frame.positions, all.frames[at].positions) << name;
          EXPECT_EQ(frame.gop.source_frame, all.frames[at].gop.source_frame) << name;
          ++at;
        }
      }
    }
  }
}

TEST(Relay, WhatAViewerReceivedSoFarIsThePrefixOfAValidStream) {
  const Stream stream = conformance::make_stream("gops");
  const std::vector<StreamPart> parts = split_whole(stream).parts;
  const Stream whole = assemble(parts, 1, parts.size());
  std::size_t gops = 0;
  for (const StreamPart& part : parts) gops += part.kind == StreamPart::Kind::kGop ? 1 : 0;
  ASSERT_GT(gops, 1U);
  for (std::size_t size = 8; size < whole.size(); size += 17) {
    const DecodedStream seen =
        decode_stream(Stream(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    EXPECT_EQ(seen.error.code, ErrorCode::kTruncated) << size;
  }
}

TEST(Relay, EveryTruncationIsSaidToBeOne) {
  for (const char* name : {"triangle", "gops", "two_meshes"}) {
    const Stream stream = conformance::make_stream(name);
    const Split whole = split_whole(stream);
    for (std::size_t size = 0; size < stream.size(); ++size) {
      const Split cut =
          split_whole(Stream(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(size)));
      ASSERT_TRUE(cut.error) << name << " cut to " << size;
      EXPECT_EQ(cut.error->code, ErrorCode::kTruncated) << name << " cut to " << size;
      EXPECT_LT(cut.parts.size(), whole.parts.size());
      EXPECT_TRUE(same_parts(cut.parts, whole.parts, cut.parts.size())) << name << " cut to " << size;
    }
  }
}

TEST(Relay, NoChangedByteGoesThrough) {
  std::size_t cases = 0;
  for (const char* name : {"triangle", "two_meshes"}) {
    const Stream stream = conformance::make_stream(name);
    const Split whole = split_whole(stream);
    for (std::size_t at = 0; at < stream.size(); ++at) {
      for (const int change : {0x01, 0x80, 0xFF, 0x55}) {
        Stream changed = stream;
        changed[at] = static_cast<std::uint8_t>(changed[at] ^ change);
        const Split damaged = split_whole(changed);
        ++cases;
        ASSERT_TRUE(damaged.error) << name << " byte " << at;
        EXPECT_TRUE(same_parts(damaged.parts, whole.parts, damaged.parts.size())) << name << " byte " << at;
      }
    }
  }
  EXPECT_GT(cases, 1000U);
}

TEST(Relay, AChunkAboveTheLimitIsRefusedByItsHeaderAlone) {
  const Stream stream = conformance::make_stream("gops");
  const std::vector<StreamPart> parts = split_whole(stream).parts;
  std::size_t largest = 0;
  for (const StreamPart& part : parts) largest = std::max(largest, part.chunk.size());
  RelayLimits limits;
  limits.chunk_bytes = largest;
  EXPECT_FALSE(split_whole(stream, limits).error);
  limits.chunk_bytes = largest - 1;
  ASSERT_TRUE(split_whole(stream, limits).error);
  EXPECT_EQ(split_whole(stream, limits).error->code, ErrorCode::kLimitExceeded);

  // The GOP's header and nothing of its payload.
  const auto gop = std::search(stream.begin(), stream.end(), kGopChunk.begin(), kGopChunk.end());
  limits.chunk_bytes = largest / 2;
  const Split header = split_whole(Stream(stream.begin(), gop + 16), limits);
  ASSERT_TRUE(header.error);
  EXPECT_EQ(header.error->code, ErrorCode::kLimitExceeded);
}

TEST(Relay, DeclaredLimitsAboveTheCallersAreRefused) {
  const Stream stream = conformance::make_stream("gops");
  RelayLimits limits;
  limits.stream.vertices = 2;
  ASSERT_TRUE(split_whole(stream, limits).error);
  EXPECT_EQ(split_whole(stream, limits).error->code, ErrorCode::kLimitExceeded);
}

TEST(Relay, AGopWhoseMeshIsNotInForceIsAnArgumentError) {
  const Stream stream = conformance::make_stream("two_meshes");
  StreamAssembler assembler([](std::span<const std::uint8_t>) { return Status(); });
  std::vector<StreamPart> gops;
  for (const StreamPart& part : split_whole(stream).parts) {
    if (part.kind == StreamPart::Kind::kHead) {
      ASSERT_TRUE(assembler.begin(part.limits, {}).ok());
    }
    if (part.kind == StreamPart::Kind::kMesh) {
      ASSERT_TRUE(assembler.write_mesh(part.chunk).ok());
    }
    if (part.kind == StreamPart::Kind::kGop) gops.push_back(part);
  }
  ASSERT_NE(gops.front().mesh, gops.back().mesh);
  EXPECT_TRUE(assembler.write_gop(gops.back().chunk, gops.back().frame_count).ok());
  const Status status = assembler.write_gop(gops.front().chunk, gops.front().frame_count);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::kInvalidArgument);
}

/// The mesh and the one GOP of a stream.
struct MeshAndGop {
  StreamPart head, mesh, gop;
};

MeshAndGop mesh_and_gop(std::uint32_t width) {
  std::mt19937 random(width);
  MeshAndGop result;
  for (StreamPart& part :
       split_whole(encode_sequence(random_sequence(grid(width, 3), 2, random), {})).parts) {
    if (part.kind == StreamPart::Kind::kHead) result.head = part;
    if (part.kind == StreamPart::Kind::kMesh) result.mesh = part;
    if (part.kind == StreamPart::Kind::kGop) result.gop = part;
  }
  return result;
}

TEST(Relay, AMeshThatComesAgainStaysInForceAsLongAsANewOne) {
  const MeshAndGop a = mesh_and_gop(3), b = mesh_and_gop(4), c = mesh_and_gop(5);
  StreamLimits limits = c.head.limits;
  limits.meshes = 2;
  limits.decoder_memory = std::uint64_t{1} << 28;
  Stream stream;
  StreamAssembler assembler([&stream](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  });
  ASSERT_TRUE(assembler.begin(limits, {}).ok());
  for (const MeshAndGop* one : {&a, &b, &a, &c}) ASSERT_TRUE(assembler.write_mesh(one->mesh.chunk).ok());
  for (const MeshAndGop* one : {&a, &c, &a})
    ASSERT_TRUE(assembler.write_gop(one->gop.chunk, one->gop.frame_count).ok());
  const std::uint64_t before = assembler.bytes();
  ASSERT_TRUE(assembler.write_mesh(c.mesh.chunk).ok());
  EXPECT_EQ(assembler.bytes(), before) << "the latest needs no repeating";
  ASSERT_TRUE(assembler.write_mesh(a.mesh.chunk, StreamAssembler::Again::kLeaveOut).ok());
  EXPECT_EQ(assembler.bytes(), before);
  ASSERT_TRUE(assembler.end().ok());
  const DecodedStream decoded = decode_stream(stream);
  EXPECT_TRUE(decoded.complete);
  EXPECT_TRUE(decoded.damage.empty());
  EXPECT_EQ(decoded.frames.size(), 6u);
  const Split again = split_whole(stream);
  ASSERT_FALSE(again.error);
  EXPECT_EQ(assemble(again.parts, beginning(again.parts), again.parts.size()), stream);
}

TEST(Relay, PassesDataOn) {
  std::mt19937 random(1);
  EncodeOptions options;
  options.data = {{"materials", std::vector<std::uint8_t>(300, 'a')}, {"extras", {1, 2}}};
  const Stream stream = encode_sequence(random_sequence(grid(4, 3), 2, random), options);
  const Split parts = split_whole(stream);
  ASSERT_FALSE(parts.error);
  Stream passed;
  StreamAssembler assembler([&passed](std::span<const std::uint8_t> bytes) {
    passed.insert(passed.end(), bytes.begin(), bytes.end());
    return Status();
  });
  Metadata metadata;
  for (const StreamPart& part : parts.parts) {
    Status status;
    if (part.kind == StreamPart::Kind::kHead) status = assembler.begin(part.limits, metadata);
    if (part.kind == StreamPart::Kind::kData) status = assembler.write_data(part.chunk);
    if (part.kind == StreamPart::Kind::kMesh) status = assembler.write_mesh(part.chunk);
    if (part.kind == StreamPart::Kind::kGop) status = assembler.write_gop(part.chunk, part.frame_count);
    if (part.kind == StreamPart::Kind::kEnd) status = assembler.end();
    ASSERT_TRUE(status.ok());
  }
  EXPECT_EQ(passed, stream);
}

TEST(Relay, BytesAfterTheEndAreRefused) {
  Stream stream = conformance::make_stream("triangle");
  stream.push_back(0);
  ASSERT_TRUE(split_whole(stream).error);
  EXPECT_EQ(split_whole(stream).error->code, ErrorCode::kMalformed);
}

TEST(Relay, AGopBeforeAnyMeshIsAnArgumentError) {
  StreamAssembler assembler([](std::span<const std::uint8_t>) { return Status(); });
  ASSERT_TRUE(assembler.begin({}, {}).ok());
  const Status status = assembler.write_gop({}, 1);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace tvg::test
