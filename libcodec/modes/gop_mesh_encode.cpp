#include "modes/gop_mesh_encode.hpp"

#include "planes/reference_shape_encode.hpp"
#include "quantization/lattice.hpp"
#include "quantization/lattice_over_encode.hpp"

#include <algorithm>
#include <utility>

#include <tvg/geometry.hpp>

namespace tvg {

namespace {

ReferenceShape shape_of(const CodedMesh& mesh, std::span<const float> frame, const Lattice& lattice) {
  ReferenceShape shape;
  shape.origin = lattice.origin;
  shape.step = lattice.step;
  shape.bits = lattice.fine_bits;
  shape.neighbours = kMaxPyramidNeighbours;
  shape.indices.resize(mesh.order.size());
  for (std::size_t v = 0; v < shape.indices.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      shape.indices[v][axis] =
          quantize(frame[3 * std::size_t{mesh.order[v]} + axis], lattice.origin[axis], lattice);
    }
  }
  return shape;
}

}  // namespace

EncodedGopMesh finish_mesh(EncodedMesh encoded) {
  EncodedGopMesh result;
  result.payload = mesh_payload(encoded);
  result.mesh.coded = std::move(encoded.coded);
  return result;
}

Result<EncodedGopMesh> finish_mesh(EncodedMesh encoded, std::span<const float> first_frame, int bits) {
  BoundingBox box;
  box.extend(first_frame);
  const Result<Lattice> lattice = lattice_over(box, bits, bits, {});
  if (!lattice) return lattice.error();
  const ReferenceShape shape = shape_of(encoded.coded, first_frame, *lattice);
  const Result<std::vector<Face>> faces = faces_by_traversal(encoded.coded);
  if (!faces) return faces.error();
  Result<Pyramid> pyramid =
      build_pyramid(*faces, encoded.coded.mesh.vertex_count, shape.indices, shape.neighbours);
  if (!pyramid) return pyramid.error();
  EncodedGopMesh result;
  result.payload = mesh_payload(encoded, encode_reference_shape(shape, *faces));
  result.mesh.coded = std::move(encoded.coded);
  result.mesh.pyramid = std::move(*pyramid);
  return result;
}

}  // namespace tvg
