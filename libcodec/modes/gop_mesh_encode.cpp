#include "modes/gop_mesh_encode.hpp"

#include "attributes/mesh_properties_encode.hpp"
#include "planes/reference_shape_encode.hpp"
#include "quantization/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tvg/geometry.hpp>

namespace tvg {

namespace {

/// A lattice from the smallest corner of the box on.
Lattice lattice_of(const BoundingBox& box, double cell) {
  Lattice lattice;
  lattice.origin = box.low();
  lattice.step = cell;
  if (!(cell > 0)) lattice.step = std::max(1.0, box.largest_extent());
  while (std::ldexp(lattice.step, kMaxBits) <= box.largest_extent()) lattice.step *= 2;
  lattice.fine_bits = kMinBits;
  while (std::ldexp(lattice.step, lattice.fine_bits) <= box.largest_extent()) ++lattice.fine_bits;
  return lattice;
}

ReferenceShape shape_of(const CodedMesh& mesh, std::span<const float> frame, const Lattice& lattice) {
  ReferenceShape shape;
  shape.origin = lattice.origin;
  shape.step = lattice.step;
  shape.bits = lattice.fine_bits;
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

EncodedGopMesh finish_mesh(EncodedMesh encoded, const MeshProperties& properties) {
  EncodedGopMesh result;
  encode_properties(properties, nullptr, encoded, result.mesh.animated);
  result.payload = mesh_payload(encoded);
  result.polygons_left_out = encoded.polygons_left_out;
  result.mesh.coded = std::move(encoded.coded);
  return result;
}

Result<EncodedGopMesh> finish_mesh(EncodedMesh encoded, std::span<const float> first_frame, double cell,
                                   std::uint32_t neighbours, const MeshProperties& properties,
                                   const Lattice* on) {
  BoundingBox box;
  box.extend(first_frame);
  ReferenceShape shape = shape_of(encoded.coded, first_frame, on != nullptr ? *on : lattice_of(box, cell));
  shape.neighbours = neighbours;
  const Result<std::vector<Face>> faces = faces_by_traversal(encoded.coded);
  if (!faces) return faces.error();
  Result<Pyramid> pyramid = build_pyramid(*faces, encoded.coded.mesh.vertex_count, shape.indices,
                                          shape.neighbours, encoded.coded.levels);
  if (!pyramid) return pyramid.error();
  EncodedGopMesh result;
  encode_properties(properties, &shape, encoded, result.mesh.animated);
  result.payload = mesh_payload(encoded, encode_reference_shape(shape, *faces));
  result.polygons_left_out = encoded.polygons_left_out;
  result.mesh.coded = std::move(encoded.coded);
  result.mesh.pyramid = std::move(*pyramid);
  result.mesh.shape = std::move(shape);
  return result;
}

}  // namespace tvg
