#pragma once
#include "base/checksum.hpp"
#include "container/chunk.hpp"
#include "container/gop_header.hpp"
#include "container/mesh_payload.hpp"
#include "container/packet.hpp"
#include "container/plan_payload.hpp"
#include "container/stream_writer.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

// Streams whose GOPs share planes, as far as their structure goes: what planes and frames hold is no content
// of any mode.
namespace tvg::test {

using PlanBuffer = std::vector<std::uint8_t>;

inline PlanBuffer some_mesh(std::uint8_t which) {
  return write_chunk(kMeshChunk, false, write_mesh({3, 1, false, PlanBuffer{1, 2, which}, {}}));
}

/// Planes in mode basis of a mesh.
inline PlanBuffer some_plan(Bytes mesh, std::uint8_t which, std::size_t size = 20) {
  const PlanBuffer fields(size, which);
  return write_chunk(
      kPlanChunk, false,
      write_plan({.mesh = chunk_id(mesh), .adds_to = 0, .mode = kModeBasis, .fields = fields}));
}

/// A GOP of two frames in mode basis that names these planes.
inline PlanBuffer some_gop(Bytes mesh, const std::vector<PlanBuffer>& plans, std::uint64_t first_frame) {
  ByteWriter ids;
  for (const PlanBuffer& plan : plans) ids.u32(chunk_id(plan));
  const PlanBuffer header = write_gop_header({.mesh = chunk_id(mesh),
                                              .first_frame = first_frame,
                                              .frame_count = 2,
                                              .packet_count = 3,
                                              .planes = ids.data(),
                                              .mode = kModeBasis,
                                              .fields = {}});
  ByteWriter gop;
  const std::uint32_t sum = write_packet(gop, 0, packet_kind::kHeader, header);
  for (std::uint32_t k = 1; k <= 2; ++k)
    write_packet(gop, packet_seed(sum, k), packet_kind::frame(Predictor::kRows), PlanBuffer{1, 2, 3});
  write_packet(gop, packet_seed(sum, 3), packet_kind::kDigest, PlanBuffer(9));
  return write_chunk(kGopChunk, false, gop.data());
}

inline StreamLimits limits_with_plans(std::uint32_t meshes, std::uint32_t plans) {
  StreamLimits limits{.vertices = 10,
                      .faces = 10,
                      .frames_per_gop = 4,
                      .packet_bytes = 1000,
                      .meshes = meshes,
                      .mesh_bytes = 300,
                      .decoder_memory = 0,
                      .plan_bytes = 200,
                      .components = 5,
                      .plans = plans};
  limits.decoder_memory = decoder_memory_with_plans(limits);
  return limits;
}

/// Writes such a stream.
class PlanStream {
 public:
  PlanStream(std::uint32_t meshes, std::uint32_t plans) {
    EXPECT_TRUE(writer_.write_start(limits_with_plans(meshes, plans), {}).ok());
  }

  PlanStream& mesh(Bytes chunk) {
    EXPECT_TRUE(writer_.write_mesh_chunk(chunk).ok());
    return *this;
  }
  PlanStream& plan(Bytes chunk) {
    EXPECT_TRUE(writer_.write_plan_chunk(chunk).ok());
    return *this;
  }
  /// A GOP that names these planes.
  PlanStream& gop(Bytes mesh, const std::vector<PlanBuffer>& plans) {
    gop_numbered(mesh, plans, frames_);
    frames_ += 2;
    return *this;
  }
  PlanStream& gop_numbered(Bytes mesh, const std::vector<PlanBuffer>& plans, std::uint64_t first_frame) {
    EXPECT_TRUE(writer_.write_gop_chunk(some_gop(mesh, plans, first_frame), 2).ok());
    return *this;
  }
  PlanBuffer end() {
    EXPECT_TRUE(writer_.write_end().ok());
    return stream_;
  }

 private:
  PlanBuffer stream_;
  StreamWriter writer_{[this](Bytes bytes) {
    stream_.insert(stream_.end(), bytes.begin(), bytes.end());
    return Status();
  }};
  std::uint64_t frames_ = 0;
};

}  // namespace tvg::test
