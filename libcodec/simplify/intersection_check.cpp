#include "simplify/intersection_check.hpp"

#include "simplify/moving_positions.hpp"

#include <algorithm>

namespace tvg {
namespace {

std::vector<std::size_t> spread_frames(std::size_t frame_count, std::size_t wanted) {
  std::vector<std::size_t> frames;
  const std::size_t count = std::min(frame_count, wanted);
  for (std::size_t i = 0; i < count; ++i) {
    frames.push_back(count == 1 ? 0 : i * (frame_count - 1) / (count - 1));
  }
  return frames;
}

FloatBox box_of_points(std::span<const float* const> points) {
  FloatBox box{{points[0][0], points[0][1], points[0][2]}, {points[0][0], points[0][1], points[0][2]}};
  for (const float* point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], point[axis]);
      box.high[axis] = std::max(box.high[axis], point[axis]);
    }
  }
  return box;
}

}  // namespace

IntersectionCheck::IntersectionCheck(const HalfEdgeMesh& mesh, std::span<const FramePositions> frames,
                                     std::uint32_t count)
    : mesh_(mesh), asked_(mesh.face_count(), 0) {
  const std::vector<std::size_t> chosen = spread_frames(frames.size(), count);
  frame_count_ = chosen.size();
  grids_.resize(frame_count_);
  const UnitScale scale = unit_scale(frames);
  const std::size_t vertex_count = frames[0].size() / 3;
  points_.resize(3 * frame_count_ * vertex_count);
  for (std::size_t k = 0; k < frame_count_; ++k) {
    for (std::size_t v = 0; v < vertex_count; ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        points_[3 * (frame_count_ * v + k) + axis] =
            static_cast<float>((frames[chosen[k]][3 * v + axis] - scale.center[axis]) * scale.factor);
      }
    }
  }
}

SpaceTriangle IntersectionCheck::triangle(std::size_t frame, const Face& face) const {
  SpaceTriangle result{face, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    result.points[c] = Eigen::Map<const Eigen::Vector3f>(point(frame, face[c])).cast<double>();
  }
  return result;
}

FloatBox IntersectionCheck::box(std::size_t frame, const Face& face) const {
  const std::array<const float*, 3> points = {point(frame, face[0]), point(frame, face[1]),
                                              point(frame, face[2])};
  return box_of_points(points);
}

void IntersectionCheck::rebuild() {
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
    if (mesh_.has_face(f)) faces.push_back(f);
  }
  for (FaceGrid& grid : grids_) grid.clear(4 * faces.size());
  filled(faces);
}

void IntersectionCheck::filled(std::span<const std::uint32_t> faces) {
  for (std::size_t k = 0; k < frame_count_; ++k) {
    for (const std::uint32_t f : faces) grids_[k].insert(f, box(k, mesh_.original_face(f)));
  }
}

bool IntersectionCheck::allows(const Ring& ring, std::span<const RingTriangle> triangles) {
  std::vector<Face> faces;
  for (const RingTriangle& t : triangles) {
    faces.push_back({ring.origins[t[0]], ring.origins[t[1]], ring.origins[t[2]]});
  }
  for (std::size_t k = 0; k < frame_count_; ++k) {
    if (!allows_in(k, ring, faces)) return false;
  }
  return true;
}

bool IntersectionCheck::met_before(std::size_t frame, const Ring& ring, const Face& face) const {
  const auto touches = [&face](std::uint32_t vertex) {
    return std::find(face.begin(), face.end(), vertex) != face.end();
  };
  for (const std::uint32_t f : found_) {
    if (!mesh_.has_face(f) || std::find(ring.faces.begin(), ring.faces.end(), f) != ring.faces.end())
      continue;
    const Face near = mesh_.original_face(f);
    if (std::none_of(near.begin(), near.end(), touches)) continue;
    const SpaceTriangle other = triangle(frame, near);
    for (const std::uint32_t gone : ring.faces) {
      if (triangles_meet(triangle(frame, mesh_.original_face(gone)), other)) return true;
    }
  }
  return false;
}

bool IntersectionCheck::allows_in(std::size_t frame, const Ring& ring, std::span<const Face> faces) {
  std::vector<const float*> corners;
  for (const std::uint32_t vertex : ring.origins) corners.push_back(point(frame, vertex));
  const FloatBox whole = box_of_points(corners);
  std::vector<SpaceTriangle> fresh;
  std::vector<FloatBox> boxes;
  for (const Face& face : faces) {
    fresh.push_back(triangle(frame, face));
    boxes.push_back(box(frame, face));
    for (std::size_t i = 0; i + 1 < fresh.size(); ++i) {
      if (triangles_meet(fresh[i], fresh.back())) return false;
    }
  }
  found_.clear();
  grids_[frame].find(whole, found_);
  ++question_;
  for (const std::uint32_t f : ring.faces) asked_[f] = question_;
  for (const std::uint32_t f : found_) {
    if (asked_[f] == question_ || !mesh_.has_face(f)) continue;
    asked_[f] = question_;
    const Face old = mesh_.original_face(f);
    const FloatBox old_box = box(frame, old);
    if (!whole.overlaps(old_box)) continue;
    const SpaceTriangle other = triangle(frame, old);
    for (std::size_t i = 0; i < fresh.size(); ++i) {
      if (!boxes[i].overlaps(old_box) || !triangles_meet(fresh[i], other)) continue;
      if (!met_before(frame, ring, old)) return false;
      break;
    }
  }
  return true;
}

}  // namespace tvg
