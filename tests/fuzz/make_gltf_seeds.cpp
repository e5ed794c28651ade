#include "tests/importers/scene_fixture.hpp"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <meshoptimizer.h>
#include <stdexcept>

// tvg_make_gltf_seeds FOLDER: writes seeds for gltf_fuzz into FOLDER/gltf_fuzz, as text and as binary files.
namespace {

namespace fs = std::filesystem;
using namespace tvg::cli::testing;

/// The first byte asks for the first clip, or for any, and for all meshes.
void write_seed(const fs::path& folder, const std::string& name, GltfBuilder gltf) {
  fs::create_directories(folder);
  for (const char first : {'\xf0', '\xff'}) {
    for (const bool binary : {false, true}) {
      const fs::path path = folder / (name + (first == '\xf0' ? "_clip" : "") + (binary ? ".glb" : ".gltf"));
      std::ofstream file(path, std::ios::binary);
      file << first << (binary ? gltf.binary() : gltf.text());
      file.close();
      if (!file) throw std::runtime_error("cannot write " + path.string());
    }
  }
}

GltfBuilder splines() {
  GltfBuilder gltf = morphing_triangle();
  gltf.animate(0, 0, "weights", {0, 1}, gltf.add<float>("SCALAR", {0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0}),
               "CUBICSPLINE");
  gltf.animate(0, 0, "rotation", {0, 1},
               gltf.add_normalized<std::int16_t>("VEC4", {0, 0, 0, 32767, 0, 0, 23170, 23170}), "STEP");
  return gltf;
}

GltfBuilder sparse() {
  GltfBuilder gltf = one_triangle();
  gltf.json["accessors"][0].erase("bufferView");
  gltf.json["accessors"][0]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", gltf.add_view<std::uint16_t>({1, 2})}, {"componentType", 5123}}},
      {"values", {{"bufferView", gltf.add_view<float>({5, 0, 0, 0, 6, 0})}}}};
  gltf.json["meshes"][0]["primitives"][0]["mode"] = 5;
  gltf.json["nodes"][0]["matrix"] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, -2, 0, 0, 5, 0, 1};
  gltf.json["nodes"].push_back({{"mesh", 0}, {"scale", {-1, 1, 1}}});
  gltf.json["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", gltf.add<float>("VEC3", {0, 0, 0, 3, 0, 0})}};
  set_roots(gltf, {0, 1});
  return gltf;
}

/// With attributes, materials, pictures and extras.
GltfBuilder dressed() {
  GltfBuilder gltf = one_triangle();
  nlohmann::json& primitive = gltf.json["meshes"][0]["primitives"][0];
  primitive["attributes"]["TEXCOORD_0"] = gltf.add<float>("VEC2", {0, 0, 1, 0, 0, 1});
  primitive["attributes"]["NORMAL"] =
      gltf.add_normalized<std::int8_t>("VEC3", {127, 0, 0, 0, 127, 0, 0, 0, 127});
  primitive["attributes"]["COLOR_0"] =
      gltf.add_normalized<std::uint8_t>("VEC3", {255, 0, 9, 8, 7, 6, 5, 4, 3});
  primitive["attributes"]["_NUMBER"] = gltf.add<std::uint16_t>("SCALAR", {1, 2, 3});
  primitive["material"] = 0;
  gltf.json["materials"] = {{{"name", "a"}}, {{"name", "a"}}};
  gltf.json["textures"] = {{{"source", 0}}};
  gltf.json["images"] = {{{"bufferView", gltf.add_view("picture")}}, {{"uri", "data:image/png;base64,AAAA"}}};
  gltf.json["nodes"][0]["extras"] = {{"key", 1}};
  return gltf;
}

template <class T>
std::string compressed(const std::vector<T>& values, std::size_t count) {
  const std::size_t stride = values.size() * sizeof(T) / count;
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, stride));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), values.data(), count, stride));
  return {bytes.begin(), bytes.end()};
}

/// Puts the compressed bytes of a view where its number stands.
void compress(GltfBuilder& gltf, int view, const std::string& bytes, std::size_t count, std::size_t stride,
              const std::string& mode, const std::string& filter) {
  const int at = gltf.add_view(bytes);
  const nlohmann::json offset = gltf.json["bufferViews"][static_cast<std::size_t>(at)]["byteOffset"];
  gltf.json["bufferViews"][static_cast<std::size_t>(view)]["extensions"]["EXT_meshopt_compression"] = {
      {"buffer", 0},          {"byteOffset", offset}, {"byteLength", bytes.size()},
      {"byteStride", stride}, {"count", count},       {"mode", mode},
      {"filter", filter}};
}

GltfBuilder meshopt() {
  GltfBuilder gltf = one_triangle();
  compress(gltf, 0, compressed<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3), 3, 12, "ATTRIBUTES", "NONE");
  const std::vector<unsigned> corners = {0, 1, 2};
  std::vector<unsigned char> bytes(meshopt_encodeIndexBufferBound(3, 3));
  bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), corners.data(), 3));
  compress(gltf, 1, {bytes.begin(), bytes.end()}, 3, 2, "TRIANGLES", "NONE");
  const std::vector<float> shift = {0, 0, 0, 3.5F, 0, -1.25F};
  std::vector<std::uint32_t> exponential(shift.size());
  meshopt_encodeFilterExp(exponential.data(), 2, 12, 15, shift.data());
  gltf.animate(0, 0, "translation", {0, 1}, "VEC3", shift);
  const auto moved = gltf.json["accessors"].back()["bufferView"].get<int>();
  compress(gltf, moved, compressed(exponential, 2), 2, 12, "ATTRIBUTES", "EXPONENTIAL");
  const std::vector<float> turn = {0, 0, 0, 1, 0, 0, kHalf, kHalf};
  std::vector<std::int16_t> quaternions(turn.size());
  meshopt_encodeFilterQuat(quaternions.data(), 2, 8, 16, turn.data());
  const int turned = gltf.add_normalized<std::int16_t>("VEC4", quaternions);
  compress(gltf, gltf.json["accessors"].back()["bufferView"].get<int>(), compressed(quaternions, 2), 2, 8,
           "ATTRIBUTES", "QUATERNION");
  gltf.animate(0, 0, "rotation", {0, 1}, turned, "LINEAR");
  return gltf;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: tvg_make_gltf_seeds FOLDER\n");
    return 1;
  }
  try {
    const fs::path folder = fs::path(argv[1]) / "gltf_fuzz";
    write_seed(folder, "skin", skinned_strip());
    write_seed(folder, "two", two_triangles());
    write_seed(folder, "splines", splines());
    write_seed(folder, "sparse", sparse());
    write_seed(folder, "meshopt", meshopt());
    write_seed(folder, "dressed", dressed());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tvg_make_gltf_seeds: %s\n", error.what());
    return 2;
  }
}
