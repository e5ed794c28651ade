#include "encoder/importers/assimp_polygons.hpp"

#include <algorithm>
#include <assimp/scene.h>
#include <optional>

namespace tvg::cli {

namespace {

Eigen::Vector3d corner(const aiMesh& mesh, const aiFace& face, unsigned at) {
  const aiVector3D& point = mesh.mVertices[face.mIndices[at % face.mNumIndices]];
  return {double{point.x}, double{point.y}, double{point.z}};
}

/// The corner, of the first ones, around which a fan fills a polygon; nothing where it is none of them.
std::optional<unsigned> fan_center(const aiMesh& mesh, const aiFace& face) {
  // A polygon of many corners is tried at few of them, so that no file takes long.
  constexpr unsigned kMostTries = 16;
  const unsigned count = face.mNumIndices;
  for (unsigned i = 0; i < count; ++i) {
    if (face.mIndices[i] >= mesh.mNumVertices) return 0;  // refused later
  }
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  const Eigen::Vector3d origin = corner(mesh, face, 0);
  for (unsigned i = 1; i + 1 < count; ++i)
    normal += (corner(mesh, face, i) - origin).cross(corner(mesh, face, i + 1) - origin);
  const double tolerance = 1e-9 * normal.squaredNorm();
  for (unsigned center = 0; center < std::min(count, kMostTries); ++center) {
    bool fills = true;
    const Eigen::Vector3d middle = corner(mesh, face, center);
    for (unsigned i = 1; fills && i + 1 < count; ++i) {
      const Eigen::Vector3d first = corner(mesh, face, center + i) - middle;
      const Eigen::Vector3d second = corner(mesh, face, center + i + 1) - middle;
      fills = first.cross(second).dot(normal) >= -tolerance;
    }
    if (fills) return center;
  }
  return std::nullopt;
}

bool is_polygon(const aiFace& face) {
  return face.mNumIndices > 3 && face.mIndices != nullptr;
}

}  // namespace

bool are_fans(const aiScene& scene) {
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh* const mesh = scene.mMeshes[i];
    if (mesh == nullptr || mesh->mVertices == nullptr || mesh->mFaces == nullptr) continue;
    for (unsigned face = 0; face < mesh->mNumFaces; ++face) {
      if (is_polygon(mesh->mFaces[face]) && !fan_center(*mesh, mesh->mFaces[face])) return false;
    }
  }
  return true;
}

void read_assimp_faces(const aiMesh& mesh, ScenePart& part) {
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices < 3 || face.mIndices == nullptr) {
      ++part.left_out;
      continue;
    }
    const unsigned center = is_polygon(face) ? fan_center(mesh, face).value_or(0) : 0;
    if (is_polygon(face)) part.polygons.push_back({part.faces.size(), face.mNumIndices});
    const auto at = [&](unsigned number) { return face.mIndices[(center + number) % face.mNumIndices]; };
    for (unsigned k = 1; k + 1 < face.mNumIndices; ++k) part.faces.push_back({at(0), at(k), at(k + 1)});
  }
}

}  // namespace tvg::cli
