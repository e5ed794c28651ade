#pragma once
#include "tests/importers/io_toolbox.hpp"

#include <string>

namespace tvg::cli::testing {

/// The tetrahedron in each format.
inline std::string sample_obj() {
  return "# sample\no thing\nv 0 0 0\nv 1 0 0\nv 0 1 0.125\nv 0 -0.5 1\nvn 0 0 1\nvt 0 0\n"
         "f 1 3 2\nf 1/1 2/1 4/1\nf 1//1 4//1 3//1\nf -3/1/1 -2/1/1 -1/1/1\n";
}

inline std::string sample_off() {
  return "OFF\n# sample\n4 4 6\n0 0 0\n1 0 0\n0 1 0.125\n0 -0.5 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}

inline std::string sample_ply_ascii() {
  return "ply\nformat ascii 1.0\ncomment sample\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n0 1 0.125\n0 -0.5 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}

/// With properties and elements that a reader must walk over.
inline std::string sample_ply_binary(bool big_endian) {
  ByteString bytes(big_endian);
  bytes.text("ply\nformat binary_")
      .text(big_endian ? "big" : "little")
      .text("_endian 1.0\nobj_info sample\n");
  bytes.text("element camera 1\nproperty list ushort double matrix\nproperty short id\n");
  bytes.text("element vertex 4\nproperty uchar red\nproperty double z\nproperty list uchar short bones\n");
  bytes.text("property float x\nproperty int y\n");
  bytes.text(
      "element face 4\nproperty char group\nproperty list int uint vertex_index\nproperty float area\n");
  bytes.text("element nothing 7\nelement edge 1\nproperty int vertex1\nend_header\n");
  bytes.add(std::uint16_t{2}).add(1.5).add(2.5).add(std::int16_t{-1});
  const float x[] = {0, 1, 0, 0};
  const std::int32_t y[] = {0, 0, 1, -5};
  const double z[] = {0, 0, 0.125, 1};
  for (std::size_t vertex = 0; vertex < 4; ++vertex) {
    bytes.add(std::uint8_t{200}).add(z[vertex]).add(static_cast<std::uint8_t>(vertex));
    for (std::size_t bone = 0; bone < vertex; ++bone) bytes.add(std::int16_t{7});
    bytes.add(x[vertex]).add(y[vertex]);
  }
  for (const Face& face : kTetrahedron) {
    bytes.add(std::int8_t{-1}).add(std::int32_t{3});
    for (const std::uint32_t index : face) bytes.add(index);
    bytes.add(0.5F);
  }
  bytes.add(std::int32_t{3});
  return bytes.bytes();
}

inline std::string sample_stl_ascii() {
  std::string text = "solid thing facet\n";
  const FramePositions positions = tetrahedron_positions(0);
  for (const Face& face : kTetrahedron) {
    text += "  facet normal 0 0 nan\n    outer loop\n";
    for (const std::uint32_t index : face) {
      text += "      vertex";
      for (std::size_t axis = 0; axis < 3; ++axis)
        text.append(1, ' ').append(std::to_string(positions[3 * index + axis]));
      text += "\n";
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid thing\n";
}

inline std::string sample_stl_binary(const FramePositions& positions) {
  ByteString bytes(false);
  bytes.text("solid but binary")
      .text(std::string(64, ' '))
      .add(static_cast<std::uint32_t>(kTetrahedron.size()));
  for (const Face& face : kTetrahedron) {
    bytes.add(0.0F).add(0.0F).add(0.0F);
    for (const std::uint32_t index : face) {
      for (std::size_t axis = 0; axis < 3; ++axis) bytes.add(positions[3 * index + axis]);
    }
    bytes.add(std::uint16_t{0});
  }
  return bytes.bytes();
}

}  // namespace tvg::cli::testing
