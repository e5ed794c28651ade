#include "source/source_checks.hpp"

#include "base/errors.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace tvg {

Status check_mesh(const Mesh& mesh) {
  if (mesh.vertex_count == 0) return invalid_input("the mesh has no vertices");
  if (mesh.vertex_count > kMaxVertexCount || mesh.faces.size() > kMaxFaceCount) {
    return invalid_input("the mesh has more vertices or faces than a stream can hold");
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (const std::uint32_t corner : mesh.faces[f]) {
      if (corner >= mesh.vertex_count) {
        return invalid_input("face " + std::to_string(f) + " refers to vertex " + std::to_string(corner) +
                             ", the mesh has " + std::to_string(mesh.vertex_count));
      }
    }
  }
  return {};
}

Status check_frame(std::span<const float> frame, std::uint64_t number) {
  const auto bad = std::find_if_not(frame.begin(), frame.end(), [](float x) { return std::isfinite(x); });
  if (bad == frame.end()) return {};
  const auto i = static_cast<std::size_t>(bad - frame.begin());
  return at_frame(number, invalid_input("vertex " + std::to_string(i / 3) +
                                        " has a coordinate that is infinite or not a number"));
}

Result<bool> read_checked(FrameSource& source, FramePositions& frame, std::uint64_t number) {
  Result<bool> read = source.read_frame(frame);
  if (!read || !*read) return read;
  if (Status status = check_frame(frame, number); !status.ok()) return status.error();
  return true;
}

Status check_joints(std::span<const float> joints, const Skeleton& skeleton, std::uint64_t number) {
  const std::size_t joint_count = skeleton.joint_names.size();
  if (joints.size() != 3 * joint_count) {
    return at_frame(number, invalid_input("there are positions for " + std::to_string(joints.size() / 3) +
                                          " of the skeleton's " + std::to_string(joint_count) + " joints"));
  }
  if (!std::all_of(joints.begin(), joints.end(), [](float x) { return std::isfinite(x); })) {
    return at_frame(number, invalid_input("a joint has a coordinate that is infinite or not a number"));
  }
  return {};
}

}  // namespace tvg
