#include "base/checksum.hpp"
#include "container/chunk.hpp"
#include "container/head.hpp"
#include "container/mesh_payload.hpp"
#include "container/metadata.hpp"
#include "structures_toolbox.hpp"

#include <array>
#include <cstdint>

namespace tvg {
namespace {

TEST(ChunkHeader, ComesBackWithItsWholeSize) {
  const Buffer chunk = write_chunk(kGopChunk, true, Buffer{1, 2, 3});
  ASSERT_EQ(chunk.size(), 23u);
  const std::optional<ChunkHeader> header = read_chunk_header(chunk);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->type, kGopChunk);
  EXPECT_TRUE(header->ancillary);
  EXPECT_EQ(header->length, 3u);
  EXPECT_EQ(header->total_size(), 23u);
  EXPECT_FALSE(read_chunk_header(write_chunk(kHeadChunk, false, {}))->ancillary);
}

TEST(ChunkHeader, EverySingleByteChangeIsRefused) {
  const Buffer good = write_chunk(kMeshChunk, false, Buffer(5, 9));
  for (std::size_t i = 0; i < kChunkHeaderSize; ++i) {
    for (int change = 1; change < 256; ++change) {
      Buffer bytes = good;
      bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ change);
      EXPECT_FALSE(read_chunk_header(bytes)) << i;
    }
  }
  for (std::size_t length = 0; length < kChunkHeaderSize; ++length) {
    EXPECT_FALSE(read_chunk_header(Bytes(good).first(length)));
  }
}

TEST(ChunkHeader, ReservedBitsLettersAndLengthAreRefusedThoughTheChecksumFits) {
  const auto header = [](std::array<std::uint8_t, 4> type, std::uint32_t flags, std::uint32_t length) {
    ByteWriter writer;
    writer.bytes(type);
    writer.u32(flags);
    writer.u32(length);
    writer.u32(checksum(writer.data()));
    return read_chunk_header(writer.data()).has_value();
  };
  EXPECT_TRUE(header({'A', 'b', '1', ' '}, 1, kMaxChunkLength));
  EXPECT_FALSE(header({'A', 'b', '1', ' '}, 2, 0));
  EXPECT_FALSE(header({'A', 'b', '1', ' '}, 0x80000000, 0));
  EXPECT_FALSE(header({'A', 'b', '1', 0x1F}, 0, 0));
  EXPECT_FALSE(header({'A', 'b', 0x7F, ' '}, 0, 0));
  EXPECT_FALSE(header({0xC3, 'b', '1', ' '}, 0, 0));
  EXPECT_FALSE(header({'A', 'b', '1', ' '}, 0, kMaxChunkLength + 1));
}

StreamLimits some_limits() {
  StreamLimits limits{1000, 2000, 50, 24256, 3, 12345, 0};
  limits.decoder_memory = decoder_memory_needed(limits) + 17;
  return limits;
}

/// A head of these keys and values.
Result<StreamHead> read_bounds(const std::vector<std::uint64_t>& keys_and_values) {
  ByteWriter writer;
  writer.u16(kFormatMajor);
  writer.u16(kFormatMinor);
  for (const std::uint64_t value : keys_and_values) writer.varint(value);
  return read_head(writer.data());
}

TEST(Head, ComesBack) {
  const Buffer bytes = write_head(some_limits());
  const Result<StreamHead> head = read_head(bytes);
  ASSERT_TRUE(head);
  EXPECT_EQ(head->limits, some_limits());
  EXPECT_EQ(head->major, kFormatMajor);
  EXPECT_EQ(head->minor, kFormatMinor);
  expect_exact_length(bytes, read_head);
}

TEST(Head, AnotherVersionIsRefusedByItsName) {
  const Buffer good = write_head(some_limits());
  const auto with = [&](std::size_t at, std::uint8_t value) {
    Buffer bytes = good;
    bytes[at] = value;
    return read_head(bytes);
  };
  expect_refused(with(0, kFormatMajor + 1), ErrorCode::kUnsupportedVersion, "§4.1");
  expect_refused(with(2, kFormatMinor + 1), ErrorCode::kUnsupportedVersion, "§4.1");
  expect_refused(with(2, 1), ErrorCode::kUnsupportedVersion, "§4.1");
  EXPECT_NE(with(2, 99).error().message.find("99"), std::string::npos) << "the version is named";
  EXPECT_NE(with(2, 1).error().message.find("encode it anew"), std::string::npos) << "and what to do";
}

TEST(Head, BoundsAscendAndUnknownOnesAreSkippedOrRefusedByTheirKey) {
  const std::uint64_t memory = 1 << 22;
  EXPECT_TRUE(read_bounds({1, 8, 3, 8, 5, 2, 7, 99, 9, memory, 11, 1, 13, 64}));
  EXPECT_TRUE(read_bounds({0, 7, 1, 8, 3, 8, 4, 4, 5, 2, 7, 99, 9, memory, 11, 1, 13, 64, 1000, 1}));
  expect_refused(read_bounds({1, 8, 3, 8, 5, 2, 7, 99, 9, memory, 11, 1, 13, 64, 23, 1}),
                 ErrorCode::kUnsupportedVersion, "§4.1");
  expect_refused(read_bounds({3, 8, 1, 8, 5, 2, 7, 99, 9, memory, 11, 1, 13, 64}), ErrorCode::kMalformed,
                 "§3.5");
  expect_refused(read_bounds({1, 8, 3, 8, 5, 2, 7, 99, 9, memory, 11, 1}), ErrorCode::kMalformed, "§4.1");
  expect_refused(read_bounds({1, 8, 3, 8, 5, 2, 7, 99, 9, 1 << 20, 11, 1, 13, 64}), ErrorCode::kMalformed,
                 "§4.1");
}

TEST(Head, HasBoundsOfPlanesOnlyWhereThereAreAny) {
  const Buffer without = write_head(some_limits());
  StreamLimits limits = some_limits();
  limits.components = 7;
  limits.plans = 9;
  EXPECT_EQ(write_head(limits), without);
  limits.plan_bytes = 500;
  limits.decoder_memory = decoder_memory_with_plans(limits);
  const Result<StreamHead> back = read_head(write_head(limits));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->limits, limits);
  --limits.decoder_memory;
  expect_refused(read_head(write_head(limits)), ErrorCode::kMalformed, "§4.1");
  EXPECT_EQ(read_head(without)->limits, some_limits()) << "one chunk of no bytes and no components";
}

TEST(Head, HasABoundOfPropertiesOnlyWhereThereAreAny) {
  StreamLimits limits = some_limits();
  limits.property_bytes = 1000;
  limits.decoder_memory = decoder_memory_needed(limits);
  const Buffer written = write_head(limits);
  EXPECT_GT(written.size(), write_head(some_limits()).size());
  const Result<StreamHead> back = read_head(written);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->limits, limits);
  EXPECT_EQ(larger_limits(some_limits(), limits).property_bytes, 1000u);
  --limits.decoder_memory;
  expect_refused(read_head(write_head(limits)), ErrorCode::kMalformed, "§4.1");
}

TEST(Head, BoundsOfPlanesOutOfRangeAreRefused) {
  const auto read = [](std::uint64_t key, std::uint64_t value) {
    return read_bounds({1, 8, 3, 8, 5, 2, 7, 99, 9, std::uint64_t{1} << 50, 11, 1, 13, 64, key, value});
  };
  EXPECT_TRUE(read(15, 0xFFFFFFFF));
  EXPECT_TRUE(read(17, 65535));
  EXPECT_TRUE(read(19, 1));
  EXPECT_TRUE(read(19, 256));
  expect_refused(read(15, 0x100000000), ErrorCode::kMalformed, "§4.1");
  expect_refused(read(17, 65536), ErrorCode::kMalformed, "§4.1");
  expect_refused(read(19, 0), ErrorCode::kMalformed, "§4.1");
  expect_refused(read(19, 257), ErrorCode::kMalformed, "§4.1");
}

TEST(Head, TheLimitsOfTwoStreamsTogetherHoldForBoth) {
  StreamLimits a = some_limits(), b = some_limits();
  a.vertices = 5000;
  a.decoder_memory = decoder_memory_needed(a);
  b.meshes = 9;
  b.decoder_memory = decoder_memory_needed(b);
  const StreamLimits both = larger_limits(a, b);
  EXPECT_EQ(both.vertices, 5000u);
  EXPECT_EQ(both.meshes, 9u);
  EXPECT_EQ(both.decoder_memory, decoder_memory_needed(both)) << "more than either alone";
  b.decoder_memory = decoder_memory_with_shapes(b);
  const StreamLimits with_shapes = larger_limits(a, b);
  EXPECT_EQ(with_shapes.decoder_memory, decoder_memory_with_shapes(with_shapes));
  b.plan_bytes = 700;
  b.components = 40;
  b.plans = 5;
  b.decoder_memory = decoder_memory_with_plans(b);
  const StreamLimits with_plans = larger_limits(a, b);
  EXPECT_EQ(with_plans.plan_bytes, 700u);
  EXPECT_EQ(with_plans.components, 40u);
  EXPECT_EQ(with_plans.plans, 5u);
  EXPECT_EQ(with_plans.decoder_memory, decoder_memory_with_plans(with_plans));
}

TEST(MetadataLayout, ComesBackInUtf8) {
  const Metadata metadata = {{"fps", "30000/1001"}, {"name", "Hühnchen 🐔"}, {"ключ", ""}};
  const Buffer bytes = write_metadata(metadata);
  const Result<Metadata> back = read_metadata(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, metadata);
  expect_exact_length(bytes, read_metadata);
  EXPECT_TRUE(read_metadata(write_metadata({})));
}

TEST(MetadataLayout, EmptyDoubleOrUnorderedKeysAndUndueCountsAreRefused) {
  const auto read = [](std::uint64_t count, const std::vector<std::string>& texts) {
    ByteWriter writer;
    writer.varint(count);
    for (const std::string& text : texts) {
      writer.varint(text.size());
      for (const char c : text) writer.u8(static_cast<std::uint8_t>(c));
    }
    return read_metadata(writer.data());
  };
  EXPECT_TRUE(read(2, {"a", "1", "b", "2"}));
  expect_refused(read(1, {"", "1"}), ErrorCode::kMalformed, "§4.2");
  expect_refused(read(2, {"a", "1", "a", "2"}), ErrorCode::kMalformed, "§4.2");
  expect_refused(read(2, {"b", "1", "a", "2"}), ErrorCode::kMalformed, "§4.2");
  expect_refused(read(1, {"a", "1", "b", "2"}), ErrorCode::kMalformed, "§4.2");
  expect_refused(read(~std::uint64_t{0}, {"a", "1"}), ErrorCode::kMalformed, "§4.2");
}

TEST(MetadataLayout, WhatIsNoTextInUtf8IsRefused) {
  const std::string bad[] = {
      std::string("a\0b", 3),  // cannot be asked for through the C interface
      "\x80",                  // a continuation first
      "\xC3",                  // cut
      "\xC3(",                 // not continued
      "\xC0\xAF",              // over-long forms
      "\xE0\x9F\xBF",          //
      "\xF0\x8F\xBF\xBF",      //
      "\xED\xA0\x80",          // a surrogate
      "\xF4\x90\x80\x80",      // above U+10FFFF
      "\xFF",                  //
  };
  for (const std::string& text : bad) {
    expect_refused(read_metadata(write_metadata({{text, "value"}})), ErrorCode::kMalformed, "§4.2");
    expect_refused(read_metadata(write_metadata({{"key", text}})), ErrorCode::kMalformed, "§4.2");
  }
  EXPECT_TRUE(read_metadata(write_metadata({{"\t\xDF\xBF\xEF\xBF\xBF", "\xF4\x8F\xBF\xBF\n"}})));
}

TEST(MeshChunk, ComesBack) {
  const Buffer connectivity = {1, 2, 3}, order = {4, 5};
  const Buffer bytes = write_mesh({1000, 0, true, connectivity, order});
  const Result<MeshLayout> mesh = read_mesh(bytes);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->vertex_count, 1000u);
  EXPECT_EQ(mesh->face_count, 0u);
  EXPECT_TRUE(mesh->keeps_order);
  EXPECT_EQ(Buffer(mesh->connectivity.begin(), mesh->connectivity.end()), connectivity);
  EXPECT_EQ(Buffer(mesh->order.begin(), mesh->order.end()), order);
  EXPECT_FALSE(read_mesh(write_mesh({1, 1, false, connectivity, {}}))->keeps_order);
}

TEST(MeshChunk, CountsAndSectionsOutOfRangeAreRefused) {
  struct Section {
    std::uint64_t kind;
    Buffer content;
  };
  const auto read = [](std::uint64_t vertices, std::uint64_t faces, const std::vector<Section>& sections) {
    ByteWriter writer;
    writer.varint(vertices);
    writer.varint(faces);
    for (const Section& section : sections) {
      writer.varint(section.kind);
      writer.varint(section.content.size());
      writer.bytes(section.content);
    }
    const Result<MeshLayout> mesh = read_mesh(writer.data());
    return mesh ? Status() : Status(mesh.error());
  };
  const auto refused = [](const Status& status, ErrorCode code, const std::string& section) {
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, code);
    EXPECT_EQ(status.error().section, section);
  };
  const Section connectivity{1, {1, 2, 3}};
  EXPECT_TRUE(read(5, 5, {connectivity}).ok());
  EXPECT_TRUE(read(5, 5, {{0, {}}, connectivity, {3, {0}}, {8, {9}}, {10, {}}}).ok())
      << "even ones are skipped";
  refused(read(0, 5, {connectivity}), ErrorCode::kMalformed, "§4.3");
  refused(read(0x80000000, 5, {connectivity}), ErrorCode::kMalformed, "§4.3");
  refused(read(std::uint64_t{1} << 32 | 5, 5, {connectivity}), ErrorCode::kMalformed, "§4.3");
  refused(read(5, 0x80000000, {connectivity}), ErrorCode::kMalformed, "§4.3");
  refused(read(5, 5, {{3, {0}}}), ErrorCode::kMalformed, "§4.3");
  refused(read(5, 5, {connectivity, connectivity}), ErrorCode::kMalformed, "§3.5");
  refused(read(5, 5, {connectivity, {2, {}}}), ErrorCode::kMalformed, "§5.8");
  refused(read(5, 5, {connectivity, {4, {}}}), ErrorCode::kMalformed, "§5.7");
  refused(read(5, 5, {connectivity, {6, {}}}), ErrorCode::kMalformed, "§5.9");
  refused(read(5, 5, {connectivity, {5, {}}}), ErrorCode::kMalformed, "§5.3");
  refused(read(5, 5, {connectivity, {7, {}}}), ErrorCode::kMalformed, "§5.5");
  refused(read(5, 5, {connectivity, {7, {1}}, {9, {}}}), ErrorCode::kMalformed, "§5.6");
  refused(read(5, 5, {connectivity, {9, {1}}}), ErrorCode::kMalformed, "§5.6");
  refused(read(5, 5, {connectivity, {11, {}}}), ErrorCode::kUnsupported, "§4.3");
  expect_refused(read_mesh(Buffer{5, 5, 1, 9, 1}), ErrorCode::kMalformed, "§4.3");
}

}  // namespace
}  // namespace tvg
