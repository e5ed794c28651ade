#include "encoder/encode_checks.hpp"

#include "base/errors.hpp"
#include "connectivity/coarse_mesh.hpp"
#include "container/chunk.hpp"
#include "container/mesh_payload.hpp"
#include "container/metadata.hpp"
#include "encoder/effort.hpp"
#include "modes/basis_encode.hpp"
#include "modes/lossless_line_encode.hpp"
#include "quantization/lattice_over_encode.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <tvg/data.hpp>

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

Status check_data(const std::vector<NamedData>& data) {
  std::set<std::string_view> names;
  for (const auto& [name, bytes] : data) {
    if (name.empty() || name.size() > kMaxDataNameBytes || !is_metadata_text(name))
      return invalid_argument("a name of data is not 1 to 1024 bytes of text in UTF-8");
    if (bytes.size() > kMaxDataBytes) return invalid_argument("the data '" + name + "' are above 64 MiB");
    if (!names.insert(name).second) return invalid_argument("there are two data of the name '" + name + "'");
  }
  return {};
}

Status check_lossless(const EncodeOptions& options) {
  if (options.mode != Mode::kLossless) return {};
  if (options.fine_bits != options.coarse_bits || options.step || options.max_error)
    return invalid_argument(
        "without loss there is one resolution, that of float32: give no bits, step or largest error");
  if (options.predictor != Predictor::kElp && options.predictor != Predictor::kPyramid)
    return invalid_argument("without loss vertices are predicted along the pyramid: give no predictor");
  return {};
}

Status check_basis(const EncodeOptions& options) {
  if (options.period_frames > (1u << 16)) return invalid_argument("a period must have at most 65536 frames");
  if (options.mode == Mode::kBasis && !options.step && !options.max_error &&
      options.fine_bits > kMostBasisBits)
    return invalid_argument("mode basis takes 1 to 16 bits: use mode elp for more");
  return {};
}

Status check_max_error(const EncodeOptions& options) {
  if (!options.max_error) return {};
  if (!(options.max_error->value > 0) || !std::isfinite(options.max_error->value))
    return invalid_argument("the largest error must be above 0, and finite");
  if (options.fine_bits != options.coarse_bits)
    return invalid_argument("a largest error is one for all vertices: B2 and B1 must be the same");
  const bool of_its_own = options.max_error->of_diagonal || options.step != 2 * options.max_error->value;
  if (options.step && of_its_own)
    return invalid_argument("a step is given and a largest error: it can be one of them only");
  return {};
}

}  // namespace

Status check_options(const EncodeOptions& options) {
  if (options.mode != Mode::kElp && options.mode != Mode::kBasis && options.mode != Mode::kLossless)
    return invalid_argument("there is no such mode");
  if (Status status = check_lossless(options); !status.ok()) return status;
  if (options.fine_bits < kMinBits || options.fine_bits > kMaxBits || options.coarse_bits < kMinBits ||
      options.coarse_bits > options.fine_bits) {
    return invalid_argument(
        "bits must be 1 to 24, and those of unimportant vertices at most those of important ones");
  }
  if (options.effort < 1 || options.effort > 9) return invalid_argument("the effort must be 1 to 9");
  if (Status status = check_basis(options); !status.ok()) return status;
  if (Status status = check_max_error(options); !status.ok()) return status;
  if (options.step && !(*options.step > 0 &&
                        std::isfinite(std::ldexp(*options.step, options.fine_bits - options.coarse_bits)))) {
    return invalid_argument("the step must be a positive length in the mesh's units, and finite");
  }
  if (options.predictor == Predictor::kRows ||
      (options.predictor > Predictor::kShape && options.predictor != Predictor::kAuto))
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
  if (Status status = check_data(options.data); !status.ok()) return status;
  return check_metadata(options.metadata);
}

void add_data(std::vector<NamedData>& data, std::span<const NamedData> more) {
  const std::size_t own = data.size();
  for (const NamedData& added : more) {
    const auto end = data.begin() + static_cast<std::ptrdiff_t>(own);
    if (std::none_of(data.begin(), end,
                     [&added](const NamedData& known) { return known.name == added.name; }))
      data.push_back(added);
  }
}

Status check_pushed(const EncodeOptions& options) {
  if (options.max_error && options.max_error->of_diagonal)
    return invalid_argument("the diagonal is not known before the frames: give the error as a length");
  return check_options(options);
}

namespace {

Status check_coarse(const CoarseMesh& coarse, std::uint32_t finer, const MeshLevels& levels,
                    const Mesh& mesh) {
  if (coarse.levels == 0 || coarse.levels >= finer)
    return invalid_argument("a coarse mesh must have fewer levels than the one before it, and one at least");
  if (coarse.faces.size() > mesh.faces.size())
    return invalid_argument("a coarse mesh must not have more faces than the mesh");
  for (const Face& face : coarse.faces) {
    for (const std::uint32_t v : face) {
      if (v >= levels.level.size() || levels.level[v] >= coarse.levels)
        return invalid_argument("a face of a coarse mesh has a vertex that is not of its levels");
    }
  }
  return {};
}

}  // namespace

Status check_levels(const MeshLevels* levels, const Mesh& mesh) {
  if (levels == nullptr) return {};
  if (levels->level.size() != mesh.vertex_count)
    return invalid_argument("there must be a level for each vertex of the mesh");
  std::array<bool, kMaxVertexLevels> met{};
  std::uint32_t count = 0;
  for (const std::uint8_t level : levels->level) {
    if (level >= kMaxVertexLevels) return invalid_argument("levels must be 0 to 63");
    met[level] = true;
    count = std::max(count, level + 1u);
  }
  if (!std::all_of(met.begin(), met.begin() + count, [](bool there) { return there; }))
    return invalid_argument("there must be a vertex of each level up to the highest");
  if (levels->coarse.size() > kMaxCoarseMeshes)
    return invalid_argument("there must be at most " + std::to_string(kMaxCoarseMeshes) + " coarse meshes");
  std::uint32_t finer = count;
  for (const CoarseMesh& coarse : levels->coarse) {
    if (Status status = check_coarse(coarse, finer, *levels, mesh); !status.ok()) return status;
    finer = coarse.levels;
  }
  return {};
}

std::uint32_t frames_at_once(const EncodeOptions& options) {
  if (options.mode != Mode::kBasis) return options.gop_frames;
  return options.period_frames > 0 ? options.period_frames : effort_of(options.effort).period_frames;
}

Status resolve_max_error(EncodeOptions& options) {
  double bound = options.max_error->value;
  if (!options.box) {
    if (!options.max_error->of_diagonal) return {};
    return invalid_argument(
        "a share of the diagonal needs input that can be read twice: write the error in the mesh's units");
  }
  if (options.max_error->of_diagonal) bound *= options.box->diagonal();
  double largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(options.box->low()[axis]), std::abs(options.box->high()[axis])});
  const double rounding = (largest + bound) * 0x1p-24;
  if (bound <= 2 * rounding) {
    char least[32];
    std::snprintf(least, sizeof least, "%.3g", 2 * rounding);
    return invalid_argument("the largest error is below what float32 has at coordinates of this size, " +
                            std::string(least));
  }
  options.max_error = ErrorBound{bound - rounding, false};
  options.step = 2 * options.max_error->value;
  return {};
}

bool needs_shape(const EncodeOptions& options) {
  return options.mode != Mode::kElp || options.predictor == Predictor::kPyramid ||
         options.predictor == Predictor::kShape || options.predictor == Predictor::kAuto;
}

bool needs_box(const EncodeOptions& options) {
  return options.mode != Mode::kLossless && (options.max_error || (!options.box && !options.step));
}

double shape_cell(const EncodeOptions& options, std::span<const float> first_frame) {
  BoundingBox box;
  box.extend(first_frame);
  if (options.mode == Mode::kLossless)
    return std::ldexp(box.largest_extent(), -lossless_shape_bits(first_frame));
  const Result<Lattice> lattice =
      lattice_over(options.box.value_or(box), options.fine_bits, options.coarse_bits, options.step);
  return lattice ? lattice->step / 4 : 0;
}

namespace {

std::size_t coarse_meshes_of(const EncodeOptions& options) {
  return options.levels ? options.levels->coarse.size() : 0;
}

/// A basis has at most a component for each coordinate of its frames; two bytes a coefficient are more than
/// any takes that is worth it.
void declare_basis(StreamLimits& limits, const EncodeOptions& options) {
  limits.components = std::min({3 * frames_at_once(options), limits.vertices + 3, kMaxComponents});
  limits.plan_bytes = static_cast<std::uint32_t>(std::min<std::uint64_t>(
      65536 + std::uint64_t{2} * limits.components * limits.vertices, kMaxChunkLength));
  limits.packet_bytes = std::max(limits.packet_bytes, 256 + 24 * (limits.components + 1));
  limits.plans = static_cast<std::uint32_t>(coarse_meshes_of(options)) + 1;
  limits.decoder_memory = decoder_memory_with_plans(limits);
}

}  // namespace

StreamLimits limits_for(const Mesh& mesh, const EncodeOptions& options, std::uint64_t property_bytes,
                        std::uint64_t animated_frame_bytes) {
  StreamLimits limits;
  limits.vertices = std::max(mesh.vertex_count, options.max_vertices);
  limits.faces = std::max(static_cast<std::uint32_t>(mesh.faces.size()), options.max_faces);
  limits.frames_per_gop = options.gop_frames;
  // 64 bits per coordinate: more than the worst residual can take.
  limits.packet_bytes = static_cast<std::uint32_t>(std::min<std::uint64_t>(
      256 + 24 * std::uint64_t{limits.vertices} + animated_frame_bytes, kMaxChunkLength));
  limits.meshes = options.max_meshes;
  limits.property_bytes = std::max(static_cast<std::uint32_t>(property_bytes), options.max_property_bytes);
  limits.mesh_bytes = most_mesh_bytes(limits, needs_shape(options), coarse_meshes_of(options));
  limits.decoder_memory =
      needs_shape(options) ? decoder_memory_with_shapes(limits) : decoder_memory_needed(limits);
  if (options.mode == Mode::kBasis) declare_basis(limits, options);
  if (coarse_meshes_of(options) > 0) limits.decoder_memory = decoder_memory_with_lods(limits);
  return limits;
}

}  // namespace tvg
