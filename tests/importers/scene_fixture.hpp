#pragma once
#include "encoder/importers/open_source.hpp"
#include "tests/importers/gltf_builder.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace tvg::cli::testing {

constexpr float kHalf = static_cast<float>(std::numbers::sqrt2 / 2);  // sine and cosine of 45 degrees

class Scenes : public ::testing::Test {
 protected:
  OpenedSource open(GltfBuilder& gltf, const SceneOptions& options = {}) {
    return open_file(folder_.write("scene.gltf", gltf.text()), options);
  }
  static OpenedSource open_file(const std::string& path, const SceneOptions& options = {}) {
    SourceSpec spec{{path}};
    spec.scene = options;
    return open_source(spec);
  }
  /// The frames at a rate.
  std::vector<FramePositions> frames(GltfBuilder& gltf, const std::string& fps) {
    return read_all(*open(gltf, {"", {}, fps}).source).frames;
  }
  ToolError refusal(GltfBuilder& gltf, const SceneOptions& options) {
    return thrown_by([&] { open(gltf, options); });
  }
  TemporaryFolder folder_;
};

inline void expect_vertex(const FramePositions& frame, std::size_t vertex, float x, float y, float z) {
  EXPECT_NEAR(frame[3 * vertex], x, 1e-6) << "vertex " << vertex;
  EXPECT_NEAR(frame[3 * vertex + 1], y, 1e-6) << "vertex " << vertex;
  EXPECT_NEAR(frame[3 * vertex + 2], z, 1e-6) << "vertex " << vertex;
}

/// Puts a primitive into a mesh "Thing", and that into the one node.
inline void set_mesh(GltfBuilder& gltf, nlohmann::json primitive) {
  gltf.json["meshes"] = {{{"name", "Thing"}, {"primitives", {std::move(primitive)}}}};
  gltf.json["nodes"] = {{{"name", "ThingNode"}, {"mesh", 0}}};
  set_roots(gltf, {0});
}

/// A triangle in a node that can be moved.
inline GltfBuilder one_triangle() {
  GltfBuilder gltf;
  set_mesh(gltf, gltf.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}));
  return gltf;
}

/// A strip of six vertices, (0 or 1, row) for rows 0 to 2, whose upper bone at (0, 1) turns by 90 degrees
/// about z within a second. An ancestor moves the bones by 10 along x; the node of the mesh stands elsewhere,
/// which must not matter.
inline GltfBuilder skinned_strip() {
  GltfBuilder gltf;
  nlohmann::json primitive = gltf.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0},
                                            {0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4});
  std::vector<std::uint8_t> joints;
  for (int vertex = 0; vertex < 6; ++vertex) joints.insert(joints.end(), {0, 1, 0, 0});
  primitive["attributes"]["JOINTS_0"] = gltf.add("VEC4", joints);
  primitive["attributes"]["WEIGHTS_0"] = gltf.add<float>(
      "VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 0.5F, 0.5F, 0, 0, 0.5F, 0.5F, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
  gltf.json["meshes"] = {{{"name", "Strip"}, {"primitives", {primitive}}}};
  gltf.json["nodes"] = {{{"name", "StripNode"}, {"mesh", 0}, {"skin", 0}, {"translation", {5, 5, 5}}},
                        {{"name", "Armature"}, {"children", {2}}, {"translation", {10, 0, 0}}},
                        {{"name", "Lower"}, {"children", {3}}},
                        {{"name", "Upper"}, {"translation", {0, 1, 0}}}};
  const int bind = gltf.add<float>("MAT4", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,  //
                                            1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1});
  gltf.json["skins"] = {{{"joints", {2, 3}}, {"inverseBindMatrices", bind}}};
  gltf.animate(0, 3, "rotation", {0, 1}, "VEC4", {0, 0, 0, 1, 0, 0, kHalf, kHalf});
  gltf.json["animations"][0]["name"] = "bend";
  set_roots(gltf, {0, 1});
  return gltf;
}

/// A triangle with two morph targets: one lifts vertex 2, the other moves vertex 1.
inline GltfBuilder morphing_triangle() {
  GltfBuilder gltf;
  nlohmann::json primitive = gltf.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
  primitive["targets"] = {{{"POSITION", gltf.add<float>("VEC3", {0, 0, 0, 0, 0, 0, 0, 0, 8})}},
                          {{"POSITION", gltf.add<float>("VEC3", {0, 0, 0, 2, 0, 0, 0, 0, 0})}}};
  gltf.json["meshes"] = {{{"name", "Face"}, {"primitives", {primitive}}, {"weights", {0.25, 0}}}};
  gltf.json["nodes"] = {{{"name", "FaceNode"}, {"mesh", 0}, {"translation", {0, 0, 1}}}};
  set_roots(gltf, {0});
  return gltf;
}

/// Two triangles in nodes of their own below one that is scaled by two; one is moved by either of two clips.
inline GltfBuilder two_triangles() {
  GltfBuilder gltf;
  const nlohmann::json left = gltf.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
  const nlohmann::json right = gltf.primitive({0, 0, 0, 0, 0, 1, 0, 1, 0}, {0, 2, 1});
  gltf.json["meshes"] = {{{"name", "LeftMesh"}, {"primitives", {left}}},
                         {{"name", "RightMesh"}, {"primitives", {right}}}};
  gltf.json["nodes"] = {{{"name", "Both"}, {"children", {1, 2}}, {"scale", {2, 2, 2}}},
                        {{"name", "LeftNode"}, {"mesh", 0}},
                        {{"name", "RightNode"}, {"mesh", 1}, {"translation", {7, 0, 0}}}};
  gltf.animate(0, 1, "translation", {0, 1}, "VEC3", {0, 0, 0, 4, 0, 0});
  gltf.animate(1, 1, "translation", {2, 2.5F}, "VEC3", {0, 1, 0, 0, 3, 0});
  gltf.json["animations"][0]["name"] = "walk";
  gltf.json["animations"][1]["name"] = "jump";
  set_roots(gltf, {0});
  return gltf;
}

}  // namespace tvg::cli::testing
