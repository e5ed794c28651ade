#include "cli/stream_stretches.hpp"

#include <cstdint>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vector>

namespace tvg::cli {

namespace {

/// Frames of one mesh, one after the other.
struct ShownStretch {
  std::uint32_t mesh = 0;  ///< number in the survey
  std::uint64_t first_frame = 0;
  std::uint64_t frames = 0;
};

std::vector<ShownStretch> stretches_of(const StreamSurvey& stream) {
  std::vector<ShownStretch> stretches;
  std::uint64_t frame = 0;
  for (std::size_t i = 0; i < stream.gops.size(); ++i) {
    if (stretches.empty() || stretches.back().mesh != stream.gop_meshes[i])
      stretches.push_back({stream.gop_meshes[i], frame, 0});
    stretches.back().frames += stream.gops[i].frame_count;
    frame += stream.gops[i].frame_count;
  }
  return stretches;
}

std::uint64_t bytes_of(const MeshInfo& mesh) {
  return mesh.connectivity_bytes + mesh.order_bytes + mesh.shape_bytes + mesh.levels_bytes + mesh.lods_bytes;
}

}  // namespace

void print_stretches(const StreamSurvey& stream) {
  if (stream.meshes.size() < 2) return;
  fmt::print("\nstretches of one mesh\n  {:>8} {:>7} {:>6} {:>10} {:>10} {:>12}\n", "first", "frames", "mesh",
             "vertices", "faces", "bytes");
  std::vector<bool> told(stream.meshes.size(), false);
  for (const ShownStretch& stretch : stretches_of(stream)) {
    const SurveyedMesh& mesh = stream.meshes[stretch.mesh];
    const bool again = told[stretch.mesh];
    told[stretch.mesh] = true;
    fmt::print("  {:>8} {:>7} {:>6} {:>10} {:>10} {:>12}\n", stretch.first_frame, stretch.frames,
               stretch.mesh, mesh.vertices, mesh.faces,
               again ? "again" : fmt::format("{}", bytes_of(mesh.parts)));
  }
}

nlohmann::json json_of_stretches(const StreamSurvey& stream) {
  nlohmann::json json = nlohmann::json::array();
  for (const ShownStretch& stretch : stretches_of(stream)) {
    const SurveyedMesh& mesh = stream.meshes[stretch.mesh];
    json.push_back({{"first_frame", stretch.first_frame},
                    {"frame_count", stretch.frames},
                    {"mesh", stretch.mesh},
                    {"vertices", mesh.vertices},
                    {"faces", mesh.faces},
                    {"mesh_bytes", bytes_of(mesh.parts)}});
  }
  return json;
}

}  // namespace tvg::cli
