#include "encoder/settled_options.hpp"

#include "encoder/encode_checks.hpp"
#include "encoder/property_checks.hpp"
#include "source/source_checks.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace tvg {

namespace {

/// A decoder that keeps several meshes shall not need more for it than this, in bytes.
constexpr std::uint64_t kMostMemoryForMeshes = std::uint64_t{1} << 30;

/// What the head can say once all frames were seen, unless the options say it.
void take_facts(const EncodePlan& plan, const Mesh& first, EncodeOptions& options) {
  if (needs_box(options) && !options.box) options.box = plan.box;
  options.max_vertices = std::max(options.max_vertices, plan.vertices);
  options.max_faces = std::max(options.max_faces, plan.faces);
  options.max_property_bytes =
      std::max(options.max_property_bytes,
               static_cast<std::uint32_t>(std::min<std::uint64_t>(plan.property_bytes, UINT32_MAX)));
  options.max_animated_frame_bytes =
      std::max(options.max_animated_frame_bytes,
               static_cast<std::uint32_t>(std::min<std::uint64_t>(plan.animated_frame_bytes, UINT32_MAX)));
  const std::uint32_t asked = options.max_meshes;
  for (options.max_meshes = std::max(asked, plan.meshes);
       options.max_meshes > asked && limits_for(first, options, 0, 0).decoder_memory > kMostMemoryForMeshes;)
    --options.max_meshes;
}

/// Each frame has a mesh of its own, or nearly so, as in captured volumes.
bool is_captured(const EncodePlan& plan) {
  return plan.stretches.size() > 1 && !plan.mesh_returns && plan.frames < 2 * plan.stretches.size();
}

/// How frames are coded that have nothing to do with each other: each as the reference shape of its mesh,
/// where it has one resolution. Planes would be for one frame.
void suit_captured(const EncodePlan& plan, EncodeOptions& options) {
  constexpr std::uint32_t kFewVertices = 256;  // that do not make up for what a shape has in front
  options.keep_vertex_order = false;
  if (options.mode == Mode::kLossless) return;
  options.mode = Mode::kElp;
  const bool one_resolution = options.fine_bits == options.coarse_bits;
  options.predictor = one_resolution && plan.vertices >= kFewVertices ? Predictor::kShape : Predictor::kElp;
}

/// What lies on the surface of a single frame is predicted from its shape, which is then of more use than the
/// parallelograms of positions.
void suit_static(const FrameSource& source, EncodeOptions& options) {
  const bool has_attributes = !source.properties().attributes.empty();
  if (source.frame_count() == 1 && has_attributes && options.mode == Mode::kElp &&
      options.predictor == Predictor::kElp)
    options.predictor = Predictor::kPyramid;
}

}  // namespace

bool needs_plan(const FrameSource& source, const EncodeOptions& options) {
  return needs_box(options) || source.mesh_may_change();
}

Status check_encoding(const FrameSource& source, const EncodeOptions& options) {
  if (Status status = check_options(options); !status.ok()) return status;
  if (Status status = check_mesh(source.mesh()); !status.ok()) return status;
  if (Status status = check_properties(source.properties(), source.mesh(), options.attribute_bits);
      !status.ok())
    return status;
  return check_importance(options.importance, source.mesh(), source.skeleton());
}

Result<SettledOptions> settle_options(const FrameSource& source, EncodeOptions options,
                                      const EncodePlan* plan) {
  bool captured = false;
  suit_static(source, options);
  if (plan != nullptr && needs_plan(source, options)) {
    captured = is_captured(*plan) && options.suit_captured;
    if (captured) suit_captured(*plan, options);
    take_facts(*plan, source.mesh(), options);
  }
  if (options.max_error) {
    if (Status status = resolve_max_error(options); !status.ok()) return status.error();
  }
  if (const std::optional<std::uint64_t> frames = source.frame_count()) {
    options.period_frames =
        static_cast<std::uint32_t>(std::clamp<std::uint64_t>(*frames, 1, frames_at_once(options)));
  }
  options.metadata.merge(source.metadata());
  return SettledOptions{std::move(options), captured};
}

}  // namespace tvg
