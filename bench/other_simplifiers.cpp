#include "bench/other_simplifiers.hpp"

#include "metrics/point_triangle.hpp"

#include <Eigen/Geometry>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <limits>
#include <meshoptimizer.h>

namespace tvg::bench {

namespace {

using Eigen::Vector3d;

Vector3d point(const FramePositions& frame, std::uint32_t vertex) {
  return {frame[3 * vertex], frame[3 * vertex + 1], frame[3 * vertex + 2]};
}

/// Where a point that lies on a triangle lies in it.
std::array<double, 3> weights_of(const Vector3d& at, const Vector3d& a, const Vector3d& b,
                                 const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  const double squared = normal.squaredNorm();
  if (squared == 0) return {1, 0, 0};
  const double v = std::clamp((at - a).cross(c - a).dot(normal) / squared, 0.0, 1.0);
  const double w = std::clamp((b - a).cross(at - a).dot(normal) / squared, 0.0, 1.0 - v);
  return {1 - v - w, v, w};
}

/// The nearest place on the faces of each vertex of a frame.
std::vector<SurfacePlace> nearest_places(const std::vector<Face>& faces, const FramePositions& frame) {
  std::vector<SurfacePlace> places(frame.size() / 3);
  for (std::uint32_t vertex = 0; vertex < places.size(); ++vertex) {
    const Vector3d from = point(frame, vertex);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t face = 0; face < faces.size(); ++face) {
      const auto& [a, b, c] = faces[face];
      const Vector3d at = nearest_on_triangle(from, point(frame, a), point(frame, b), point(frame, c));
      const double distance = (at - from).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      places[vertex] = {face, weights_of(at, point(frame, a), point(frame, b), point(frame, c))};
    }
  }
  return places;
}

std::size_t used(const std::vector<unsigned>& indices) {
  std::vector<unsigned> sorted = indices;
  std::sort(sorted.begin(), sorted.end());
  return static_cast<std::size_t>(std::unique(sorted.begin(), sorted.end()) - sorted.begin());
}

}  // namespace

std::vector<Face> decimate_openmesh(const Mesh& mesh, const FramePositions& frame, std::uint32_t vertices) {
  using Triangles = OpenMesh::TriMesh_ArrayKernelT<>;
  Triangles triangles;
  triangles.request_face_status();
  triangles.request_edge_status();
  triangles.request_vertex_status();
  triangles.request_halfedge_status();
  triangles.request_face_normals();
  std::vector<Triangles::VertexHandle> handles;
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v)
    handles.push_back(triangles.add_vertex({frame[3 * v], frame[3 * v + 1], frame[3 * v + 2]}));
  for (const auto& [a, b, c] : mesh.faces) triangles.add_face(handles[a], handles[b], handles[c]);
  triangles.update_normals();
  OpenMesh::Decimater::DecimaterT<Triangles> decimater(triangles);
  OpenMesh::Decimater::ModQuadricT<Triangles>::Handle quadric;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();
  decimater.initialize();
  decimater.decimate_to(vertices);
  std::vector<Face> faces;
  for (const auto face : triangles.faces()) {
    Face corners;
    std::size_t k = 0;
    for (const auto vertex : face.vertices()) corners[k++] = static_cast<std::uint32_t>(vertex.idx());
    faces.push_back(corners);
  }
  return faces;
}

std::vector<Face> simplify_meshoptimizer(const Mesh& mesh, const FramePositions& frame,
                                         std::uint32_t vertices) {
  std::vector<unsigned> indices;
  for (const Face& face : mesh.faces) indices.insert(indices.end(), face.begin(), face.end());
  const auto simplified = [&](std::size_t faces) {
    std::vector<unsigned> result(indices.size());
    result.resize(meshopt_simplify(result.data(), indices.data(), indices.size(), frame.data(),
                                   mesh.vertex_count, 3 * sizeof(float), 3 * faces,
                                   std::numeric_limits<float>::max(), 0, nullptr));
    return result;
  };
  // Fewer faces, fewer vertices: the fewest faces that leave as many vertices as are wanted, or more.
  std::size_t low = 0, high = mesh.faces.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (used(simplified(middle)) < vertices) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  const std::vector<unsigned> result = simplified(high);
  std::vector<Face> faces;
  for (std::size_t i = 0; i < result.size(); i += 3)
    faces.push_back({result[i], result[i + 1], result[i + 2]});
  return faces;
}

SimplifiedMesh mesh_of(std::vector<Face> faces, const FramePositions& frame) {
  SimplifiedMesh result;
  result.places = nearest_places(faces, frame);
  for (const Face& face : faces) result.vertices.insert(result.vertices.end(), face.begin(), face.end());
  std::sort(result.vertices.begin(), result.vertices.end());
  result.vertices.erase(std::unique(result.vertices.begin(), result.vertices.end()), result.vertices.end());
  for (Face& face : faces) {
    for (std::uint32_t& v : face) {
      v = static_cast<std::uint32_t>(std::lower_bound(result.vertices.begin(), result.vertices.end(), v) -
                                     result.vertices.begin());
    }
  }
  result.mesh = {static_cast<std::uint32_t>(result.vertices.size()), std::move(faces)};
  return result;
}

}  // namespace tvg::bench
