#include "encoder/encode_checks.hpp"

#include "base/errors.hpp"
#include "container/chunk.hpp"
#include "container/mesh_payload.hpp"
#include "container/metadata.hpp"
#include "quantization/lattice_over_encode.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace tvg {

namespace {

constexpr std::uint64_t kMaxFirstFrame = std::uint64_t{1} << 61;  // leaves room for the frames that follow

Status check_metadata(const Metadata& metadata) {
  if (metadata.count("") > 0) return invalid_argument("a key of the metadata is empty");
  for (const auto& [key, value] : metadata) {
    if (!is_metadata_text(key)) return invalid_argument("a key of the metadata is no text in UTF-8");
    if (!is_metadata_text(value))
      return invalid_argument("the metadata's value of '" + key + "' is no text in UTF-8");
  }
  if (write_metadata(metadata).size() > kMaxMetadataPayload)
    return invalid_argument("the metadata is above 1 MiB");
  return {};
}

}  // namespace

Status check_options(const EncodeOptions& options) {
  if (options.fine_bits < kMinBits || options.fine_bits > kMaxBits || options.coarse_bits < kMinBits ||
      options.coarse_bits > options.fine_bits) {
    return invalid_argument(
        "bits must be 1 to 24, and those of unimportant vertices at most those of important ones");
  }
  if (options.step && !(*options.step > 0 &&
                        std::isfinite(std::ldexp(*options.step, options.fine_bits - options.coarse_bits)))) {
    return invalid_argument("the step must be a positive length in the mesh's units, and finite");
  }
  if (options.predictor > Predictor::kPyramid && options.predictor != Predictor::kAuto)
    return invalid_argument("there is no such predictor");
  if (options.first_frame > kMaxFirstFrame)
    return invalid_argument("the number of the first frame is too large");
  if (options.gop_frames == 0 || options.gop_frames > (1u << 16)) {
    return invalid_argument("a GOP must have 1 to 65536 frames");
  }
  if (options.max_vertices > kMaxVertexCount || options.max_faces > kMaxFaceCount) {
    return invalid_argument("the bounds are above what a stream can hold");
  }
  if (options.max_meshes == 0 || options.max_meshes > kMaxMeshesInForce)
    return invalid_argument("a decoder can be asked to keep 1 to 65536 meshes");
  if (options.box) {
    if (options.box->empty()) return invalid_argument("the box has no point");
    if (!std::isfinite(options.box->largest_extent())) return invalid_argument("the box is infinite");
    const Result<Lattice> lattice =
        lattice_over(*options.box, options.fine_bits, options.coarse_bits, options.step);
    if (!lattice) return lattice.error();
  }
  return check_metadata(options.metadata);
}

bool needs_shape(const EncodeOptions& options) {
  return options.predictor == Predictor::kPyramid || options.predictor == Predictor::kAuto;
}

StreamLimits limits_for(const Mesh& mesh, const EncodeOptions& options) {
  StreamLimits limits;
  limits.vertices = std::max(mesh.vertex_count, options.max_vertices);
  limits.faces = std::max(static_cast<std::uint32_t>(mesh.faces.size()), options.max_faces);
  limits.frames_per_gop = options.gop_frames;
  // 64 bits per coordinate: more than the worst residual can take.
  limits.packet_bytes = static_cast<std::uint32_t>(
      std::min<std::uint64_t>(256 + 24 * std::uint64_t{limits.vertices}, kMaxChunkLength));
  limits.meshes = options.max_meshes;
  limits.mesh_bytes = most_mesh_bytes(limits, needs_shape(options));
  limits.decoder_memory =
      needs_shape(options) ? decoder_memory_with_shapes(limits) : decoder_memory_needed(limits);
  return limits;
}

}  // namespace tvg
