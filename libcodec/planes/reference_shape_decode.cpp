#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "entropy/range_coder.hpp"
#include "planes/reference_shape.hpp"
#include "planes/shape_coder.hpp"

#include <cmath>

namespace tvg {

namespace {

constexpr const char* kSection = "§5.3";

/// What of a section precedes its residuals, checked.
Result<ReferenceShape> read_lattice(ByteReader& reader) {
  ReferenceShape shape;
  shape.bits = reader.u8();
  shape.neighbours = reader.u8();
  for (double& x : shape.origin) x = reader.f64();
  shape.step = reader.f64();
  if (!reader.ok()) return malformed(kSection, "the reference shape ends before its residuals");
  if (shape.bits < 1 || shape.bits > ReferenceShape::kMostBits)
    return malformed(kSection, "the reference shape's lattice has a width that is not allowed");
  if (shape.neighbours < kMinPyramidNeighbours || shape.neighbours > kMaxPyramidNeighbours) {
    return malformed(kSection, "the number of neighbours is not allowed");
  }
  bool finite = std::isfinite(shape.step) && shape.step > 0;
  for (const double x : shape.origin) finite = finite && std::isfinite(x);
  if (!finite) return malformed(kSection, "the reference shape's lattice is not finite");
  return shape;
}

}  // namespace

Result<std::vector<Face>> faces_by_traversal(const CodedMesh& mesh) {
  std::vector<std::uint32_t> index;  // of each vertex in the traversal
  std::vector<Face> faces;
  if (!try_resize(index, mesh.order.size()) || !try_reserve(faces, mesh.mesh.faces.size()))
    return out_of_memory();
  for (std::size_t t = 0; t < mesh.order.size(); ++t) index[mesh.order[t]] = static_cast<std::uint32_t>(t);
  for (const Face& face : mesh.mesh.faces) faces.push_back({index[face[0]], index[face[1]], index[face[2]]});
  return faces;
}

// format-spec §5.3
Result<ReferenceShape> decode_reference_shape(Bytes section, std::span<const Face> faces,
                                              std::uint32_t vertex_count) {
  ByteReader reader(section);
  Result<ReferenceShape> shape = read_lattice(reader);
  if (!shape) return shape;
  constexpr std::size_t kPerVertex = ShapeCoder::kBytesPerVertex + sizeof(ShapeCoder::Position);
  const std::size_t vertices = vertex_count;
  if (faces.size() > static_cast<std::size_t>(-1) / 8 / ShapeCoder::kBytesPerFace ||
      vertices > static_cast<std::size_t>(-1) / 8 / kPerVertex ||
      !can_allocate(kPerVertex * vertices + ShapeCoder::kBytesPerFace * faces.size() +
                    ShapeCoder::kModelBytes + kSmallThings)) {
    return out_of_memory();
  }
  shape->indices.resize(vertex_count);
  RangeDecoder coder(reader.bytes(reader.left()));
  ShapeCoder shape_coder(faces, vertex_count, shape->bits);
  if (!shape_coder.code(coder, shape->indices) || !coder.finished())
    return malformed(kSection, "the residuals of the reference shape are damaged");
  return shape;
}

}  // namespace tvg
