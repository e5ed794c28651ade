#include "base/checksum.hpp"
#include "container/chunk.hpp"
#include "container/gop_header.hpp"
#include "container/head.hpp"
#include "container/mesh_payload.hpp"
#include "container/packet.hpp"
#include "container/stream_writer.hpp"
#include "judge.hpp"
#include "modes/elp_header.hpp"
#include "repair.hpp"

#include <array>
#include <chrono>
#include <gtest/gtest.h>
#include <iostream>

namespace tvg::corruption {
namespace {

using Stream = std::vector<std::uint8_t>;

constexpr std::uint64_t kHuge = 0x7FFFFFFF;
constexpr ChunkType kNote = {'n', 'o', 't', 'e'};

void append(Stream& stream, const Stream& bytes) {
  stream.insert(stream.end(), bytes.begin(), bytes.end());
}

/// A stream of these limits and chunks.
Stream stream_of(const StreamLimits& limits, const std::vector<Stream>& chunks) {
  Stream stream(kSignature.begin(), kSignature.end());
  append(stream, write_chunk(kHeadChunk, false, write_head(limits)));
  for (const Stream& chunk : chunks) append(stream, chunk);
  return stream;
}

/// A stream that declares as much as a decoder lets it.
Stream hostile(const std::vector<Stream>& chunks) {
  StreamLimits limits{1u << 22, 1u << 22, 1u << 16, 1u << 28, 4, 1u << 28, 0};
  limits.decoder_memory = decoder_memory_needed(limits);
  return stream_of(limits, chunks);
}

/// The same of planes.
Stream hostile_planes(const std::vector<Stream>& chunks) {
  StreamLimits limits{1u << 10, 1u << 10, 1u << 16, 1u << 28, 4, 1u << 28, 0, 1u << 28, 1u << 9, 256};
  limits.decoder_memory = decoder_memory_with_plans(limits);
  return stream_of(limits, chunks);
}

Stream mesh_chunk(std::uint32_t vertices, std::uint32_t faces, std::size_t connectivity, std::uint8_t fill) {
  const Stream bytes(connectivity, fill);
  return write_chunk(kMeshChunk, false, write_mesh({vertices, faces, false, bytes, {}}));
}

/// `count` as a varint with some bytes behind it, as the payload of a chunk.
Stream count_chunk(ChunkType type, std::uint64_t count, std::size_t fill) {
  ByteWriter payload;
  payload.varint(count);
  payload.bytes(Stream(fill, 1));
  return write_chunk(type, false, payload.data());
}

/// A chunk header that promises more than follows.
Stream long_chunk(ChunkType type, std::uint32_t length, bool ancillary = true) {
  Stream chunk = write_chunk(type, ancillary, {});
  chunk.resize(kChunkHeaderSize - 8);
  ByteWriter rest;
  rest.u32(length);
  Stream header = chunk;
  append(header, rest.data());
  ByteWriter sum;
  sum.u32(checksum(header));
  append(header, sum.data());
  return header;
}

/// A mesh of one vertex, and a GOP that says it has frames without end.
std::vector<Stream> empty_frames() {
  Stream mesh = write_chunk(kMeshChunk, false, write_mesh({1, 0, false, Stream{0}, {}}));
  ByteWriter gop;
  ByteWriter fields;
  write_channels(fields, {});
  fields.bytes(write_elp_header(
      PredictorSet(15), {.origin = {0, 0, 0}, .step = 1e-300, .fine_bits = 24, .coarse_bits = 1}, {}));
  GopHeader header;
  header.mesh = chunk_id(mesh);
  header.frame_count = 1u << 16;
  header.packet_count = kHuge;
  header.fields = fields.data();
  write_packet(gop, 0, packet_kind::kHeader, write_gop_header(header));
  gop.u8(packet_kind::kFrame);
  gop.varint(kHuge);
  return {mesh, write_chunk(kGopChunk, false, gop.data())};
}

struct HostileFile {
  const char* what;
  Stream stream;
};

std::vector<HostileFile> hostile_files() {
  std::vector<Stream> nested;
  for (int i = 0; i < 10; ++i) nested.push_back(long_chunk(kMeshChunk, 1000 + static_cast<std::uint32_t>(i)));
  return {
      {"limits only", hostile({})},
      {"millions of vertices in one byte", hostile({mesh_chunk(1u << 22, 1u << 22, 1, 0)})},
      {"as many vertices as the bytes may stand for", hostile({mesh_chunk(12800, 0, 100, 0)})},
      {"as many faces as the bytes may stand for", hostile({mesh_chunk(3, 12797, 100, 0)})},
      {"roots", hostile({mesh_chunk(6400, 6400, 100, 0xFF)})},
      {"noise", hostile({mesh_chunk(4000, 8000, 100, 0x5A)})},
      {"data without end", hostile({long_chunk(kDataChunk, 1u << 26)})},
      {"planes without end", hostile_planes({mesh_chunk(1, 0, 1, 0), count_chunk(kPlanChunk, kHuge, 100)})},
      {"planes that are announced only",
       hostile_planes({mesh_chunk(1, 0, 1, 0), long_chunk(kPlanChunk, 1u << 28, false)})},
      {"metadata without end", hostile({count_chunk(kMetadataChunk, kHuge, 100)})},
      {"an index without end", hostile({count_chunk(kIndexChunk, kHuge, 100)})},
      {"frames without end", hostile(empty_frames())},
      {"a mesh that is announced only", hostile({long_chunk(kMeshChunk, 1u << 27)})},
      {"a GOP that is announced only", hostile({long_chunk(kGopChunk, kHuge)})},
      {"a note that is announced only", hostile({long_chunk(kNote, kHuge)})},
      {"announcements", hostile(nested)},
  };
}

TEST(HostileFile, SmallFilesTakeLittleMemory) {
  constexpr std::size_t kMostMemory = std::size_t{16} << 20;
  double slowest = 0;
  std::size_t most = 0;
  for (const HostileFile& file : hostile_files()) {
    ASSERT_LE(file.stream.size(), 256u) << file.what;
    const auto start = std::chrono::steady_clock::now();
    const Verdict verdict = judge({}, file.stream);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    EXPECT_LE(verdict.memory, kMostMemory) << file.what;
    EXPECT_TRUE(verdict.error) << file.what;
    slowest = std::max(slowest, time.count());
    most = std::max(most, verdict.memory);
  }
  std::cout << "hostile files: at most " << most << " bytes and " << slowest << " ms\n";
}

/// Every sixteen bytes begin a chunk that reaches to the end: the same bytes must not be read again and
/// again.
TEST(HostileFile, WorkAfterDamageIsInProportionToTheInput) {
  const Stream header = long_chunk(kMetadataChunk, 1u << 20);
  Stream stream = hostile({});
  while (stream.size() < (std::size_t{16} << 20)) append(stream, header);
  const auto start = std::chrono::steady_clock::now();
  const Verdict verdict = judge({}, stream);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  EXPECT_TRUE(verdict.error);
  // Without a limit this reads 3 TB; with one, less than a tenth of a second's worth. Only a hang takes
  // longer.
  EXPECT_LT(time.count(), 100) << "seconds";
}

}  // namespace
}  // namespace tvg::corruption
