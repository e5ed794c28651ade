#include "decoder/exporters/frame_sink.hpp"

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

// tvg_make_importer_seeds FOLDER: writes seeds for the fuzz target of each importer in a folder of its name.
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

constexpr int kFrames = 3;

const tvg::Mesh& tetrahedron() {
  static const tvg::Mesh mesh = {4, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  return mesh;
}

void write_file(const fs::path& path, const std::string& bytes) {
  fs::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

/// A moving tetrahedron as the tool itself writes it.
std::string written(const fs::path& folder, const std::string& name, int frames,
                    const tvg::MeshProperties& properties = {}) {
  const fs::path path = folder / name;
  tvg::cli::SinkOptions options;
  options.mesh_beside_cache = false;
  const auto sink = tvg::cli::open_sink(path, options);
  sink->begin_mesh(tetrahedron(), properties, {{"name", "toy"}, {"fps", "30"}}, frames);
  for (int frame = 0; frame < frames; ++frame) {
    const float t = 0.1F * static_cast<float>(frame);
    sink->write_frame(tvg::FramePositions{t, 0, 0, 1 + t, 0, 0, t, 1, 0.125F, t, -0.5F, 1 + t});
  }
  sink->finish();
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  file.close();
  fs::remove(path);
  return bytes;
}

void write_mesh_seeds(const fs::path& target) {
  const auto out = [&target](const std::string& name, const std::string& bytes) {
    write_file(target / name, bytes);
  };
  out("obj_fuzz/written", written(target, "a.obj", 1));
  out("obj_fuzz/rich",
      "# c\no toy\nv 0 0 0 1\nv 1 0 \\\n 0\nv 0 1e-3 0\nv +1 -1 .5\nvt 0 0\nvn 0 0 1\ng x\nusemtl m\ns 1\n"
      "f 1/1/1 2//1 3/1 -1\nf -3 -2 -1\n");
  out("mtl_fuzz/rich",
      "# c\nnewmtl red paint\nKd 1 0.5 0\nKs 0 0 0\nNs 96.5\nd -halo 0.5\nTr 0.5\nillum 2\nKe 0 0 \\\n1\n"
      "map_Kd -s 1 1 1 -o 0 0 -clamp on my pictures/red.png\nmap_d a.png\nnorm n.png\nPr .3\nPm 1\nnewmtl "
      "b\n");
  out("ply_fuzz/written", written(target, "a.ply", 1));
  out("ply_fuzz/ascii",
      "ply\nformat ascii 1.0\ncomment c\nelement vertex 3\nproperty float x\nproperty double y\nproperty "
      "float "
      "z\nproperty uchar red\nelement edge 1\nproperty int a\nelement face 1\nproperty list uchar int "
      "vertex_indices\nproperty list int float t\nend_header\n0 0 0 9\n1 0 0 9\n0 1 0 9\n7\n3 0 1 2 1 0.5\n");
  out("ply_fuzz/big_endian",
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty short x\nproperty char y\nproperty uint "
      "z\nelement face 1\nproperty list ushort uint vertex_index\nend_header\n"s +
          std::string(21, '\0') + "\0\3\0\0\0\0\0\0\0\1\0\0\0\2"s);
  out("ply_fuzz/strips",
      "ply \r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty float x\r\nproperty float y\r\nproperty "
      "float z\r\n"
      "element tristrips 1\r\nproperty list int int vertex_indices\r\nend_header\r\n0 0 0\r\n1 0 0\r\n0 1 "
      "0\r\n"
      "1 1 0\r\n8 0 1 2 3 -1 0 1 2");
  out("obj_fuzz/lenient",
      "\xef\xbb\xbfv 4000000.01 nan 0\rv 4000000.02 0 0\rv 4000000.03 1 1\rf 2 3\rf 2 3 2\r\nf 2 2 3 3");
  out("off_fuzz/joined", "OFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  out("off_fuzz/written", written(target, "a.off", 1));
  out("off_fuzz/rich",
      "STCNOFF\n# c\n3 1 0\n0 0 0 0 0 1 1 1 1 1 0 0\n1 0 0 0 0 1 1 1 1 1 0 0\n0 1 0 0 0 1 1 1 1 1 0 0\n"
      "3 0 1 2 255 0 0\n");
  out("stl_fuzz/written", written(target, "a.stl", 1));
  out("stl_fuzz/ascii",
      "solid toy\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid toy\n");
}

/// With what only our own glTF says: parts, polygons, and names of attributes.
void write_scene_seed(const fs::path& target) {
  tvg::MeshProperties properties;
  properties.parts = {{"body", "front", "skin"}, {"body", "back", ""}};
  properties.face_parts = {0, 0, 1, 1};
  properties.polygons = {{0, 4}};
  properties.attributes.push_back(
      {"heat", tvg::AttributeKind::kGeneric, tvg::AttributeDomain::kVertex, 1, 0, false, {0, 1, 2, 3}, {}});
  write_file(target / "gltf_fuzz/own", "\xff" + written(target, "a.glb", kFrames, properties));
}

void write_cache_seeds(const fs::path& target) {
  for (const std::string name : {"a.pc2", "a.mdd"}) {
    const std::string bytes = written(target, name, kFrames);
    for (char options = 0; options < 16; ++options) {
      write_file(target / "cache_fuzz" / (name + std::to_string(options)), std::string{options, 3} + bytes);
    }
  }
}

void write_other_seeds(const fs::path& target) {
  const auto word = [](std::size_t value) {
    return std::string{static_cast<char>(value), static_cast<char>(value >> 8), 0, 0};
  };
  const auto array = [](const std::string& type, const std::string& data) {
    std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (2,), }";
    header.resize(117, ' ');
    return "\1\x93NUMPY\1\0"s + std::string{118, 0} + header + "\n" + data;
  };
  write_file(target / "weights_fuzz/text", "\0# c\n1\n-2.5e-1\n\n3\n"s);
  std::string frames = "{'descr': '<f2', 'fortran_order': False, 'shape': (2, 1, 3), }";
  frames.resize(117, ' ');
  write_file(target / "npy_fuzz/frames", "\0\x93NUMPY\1\0v\0"s + frames + "\n" + std::string(12, '\1'));
  // A stored and a deflated array of three bytes, 'abc'.
  const std::string sizes = "\xc2\x41\x24\x35"s, name = "a.npy";
  const std::string deflated = "\1\3\0\xfc\xff\x61\x62\x63"s;
  const auto entry = [&](char method, char stored, char offset) {
    return "PK\1\2\x14\0\x14\0\0\0"s + method + std::string(5, '\0') + sizes + stored + std::string(3, '\0') +
           "\3\0\0\0\5"s + std::string(13, '\0') + offset + std::string(3, '\0') + name;
  };
  const auto local = [&](char method, char stored, const std::string& bytes) {
    return "PK\3\4\x14\0\0\0"s + method + std::string(5, '\0') + sizes + stored + std::string(3, '\0') +
           "\3\0\0\0\5\0\0\0"s + name + bytes;
  };
  const std::string files = local(0, 3, "abc") + local(8, 8, deflated);
  const std::string directory = entry(0, 3, 0) + entry(8, 8, static_cast<char>(local(0, 3, "abc").size()));
  write_file(target / "npz_fuzz/two", files + directory + "PK\5\6"s + std::string(4, '\0') + "\2\0\2\0"s +
                                          word(directory.size()) + word(files.size()) + std::string(2, '\0'));
  write_file(target / "weights_fuzz/single", array("<f4", std::string(8, '\0')));
  write_file(target / "weights_fuzz/double", array("<f8", std::string(16, '\0')));
  write_file(target / "skeleton_fuzz/hand",
             R"({"joints":[{"name":"a","parent":null},{"name":"b","parent":0}],)"
             R"("frames":[[[0,0,0],[1,2.5,-3e2]],[[0,0,0],[1,1,1]]],"heaviest_joint":[0,1,1,0]})");
  write_file(target / "scene_header_fuzz/collada",
             "<Name_array>STEP LINEAR</Name_array><Name_array>BEZIER</Name_array>");
  for (const std::string signature : {"IDP2", "IDP3", "IDPC", "IDPO"}) {
    write_file(target / "scene_header_fuzz" / signature,
               signature + std::string(36, '\1') + word(3) + std::string(36, '\1'));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: tvg_make_importer_seeds FOLDER\n");
    return 1;
  }
  try {
    fs::create_directories(argv[1]);
    write_mesh_seeds(argv[1]);
    write_scene_seed(argv[1]);
    write_cache_seeds(argv[1]);
    write_other_seeds(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tvg_make_importer_seeds: %s\n", error.what());
    return 2;
  }
}
