#include "base/errors.hpp"
#include "encoder/encode_checks.hpp"
#include "encoder/property_checks.hpp"
#include "source/look_through.hpp"
#include "source/source_checks.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include <tvg/encoder.hpp>

namespace tvg {

namespace {

/// A decoder that keeps several meshes shall not need more for it than this, in bytes.
constexpr std::uint64_t kMostMemoryForMeshes = std::uint64_t{1} << 30;

/// What the head can say once all frames were seen, unless the options say it.
void take_facts(const SourceFacts& facts, const Mesh& first, EncodeOptions& options) {
  if (needs_box(options) && !options.box) options.box = facts.box;
  options.max_vertices = std::max(options.max_vertices, facts.vertices);
  options.max_faces = std::max(options.max_faces, facts.faces);
  options.max_property_bytes =
      std::max(options.max_property_bytes,
               static_cast<std::uint32_t>(std::min<std::uint64_t>(facts.property_bytes, UINT32_MAX)));
  options.max_animated_frame_bytes =
      std::max(options.max_animated_frame_bytes,
               static_cast<std::uint32_t>(std::min<std::uint64_t>(facts.animated_frame_bytes, UINT32_MAX)));
  const std::uint32_t asked = options.max_meshes;
  for (options.max_meshes = std::max(asked, facts.meshes);
       options.max_meshes > asked && limits_for(first, options, 0, 0).decoder_memory > kMostMemoryForMeshes;)
    --options.max_meshes;
}

/// How frames are coded that have nothing to do with each other: each as the reference shape of its mesh,
/// where it has one resolution. Planes would be for one frame.
void suit_captured(const SourceFacts& facts, EncodeOptions& options) {
  constexpr std::uint32_t kFewVertices = 256;  // that do not make up for what a shape has in front
  options.keep_vertex_order = false;
  if (options.mode == Mode::kLossless) return;
  options.mode = Mode::kElp;
  const bool one_resolution = options.fine_bits == options.coarse_bits;
  options.predictor = one_resolution && facts.vertices >= kFewVertices ? Predictor::kShape : Predictor::kElp;
}

/// What lies on the surface of a single frame is predicted from its shape, which is then of more use than the
/// parallelograms of positions.
void suit_static(const FrameSource& source, EncodeOptions& options) {
  const bool has_attributes = !source.properties().attributes.empty();
  if (source.frame_count() == 1 && has_attributes && options.mode == Mode::kElp &&
      options.predictor == Predictor::kElp)
    options.predictor = Predictor::kPyramid;
}

Result<EncodeReport> push_all(FrameSource& source, EncodeOptions options, const ByteSink& sink,
                              const EncodeProgress& progress) {
  bool captured = false;
  suit_static(source, options);
  if (needs_box(options) || source.mesh_may_change()) {
    const Result<std::optional<SourceFacts>> facts = look_through(source);
    if (!facts) return facts.error();
    captured = *facts && (*facts)->captured() && options.suit_captured;
    if (captured) suit_captured(**facts, options);
    if (*facts) take_facts(**facts, source.mesh(), options);
  }
  if (options.max_error) {
    if (Status status = resolve_max_error(options); !status.ok()) return status.error();
  }
  if (const std::optional<std::uint64_t> frames = source.frame_count()) {
    options.period_frames =
        static_cast<std::uint32_t>(std::clamp<std::uint64_t>(*frames, 1, frames_at_once(options)));
  }
  options.metadata.merge(source.metadata());
  add_data(options.data, source.data());
  EncodeProgress with_total;
  if (progress) {
    with_total = [&progress, total = source.frame_count()](
                     std::uint64_t frames, std::optional<std::uint64_t>) { progress(frames, total); };
  }
  Encoder encoder(std::move(options), sink, std::move(with_total));
  FramePositions frame;
  for (SourceStep step = SourceStep::kMesh; step != SourceStep::kEnd;) {
    Status status = step == SourceStep::kMesh
                        ? encoder.set_mesh(source.mesh(), source.skeleton(), source.properties())
                        : encoder.add_frame(frame, source.joint_positions(), all_animated_values(source));
    if (!status.ok()) return status.error();
    const Result<SourceStep> next = read_step(source, frame);
    if (!next) return next.error();
    step = *next;
  }
  Result<EncodeReport> report = encoder.finish();
  if (report) report->captured = captured;
  return report;
}

}  // namespace

Result<EncodeReport> encode(FrameSource& source, const EncodeOptions& options, const ByteSink& sink,
                            const EncodeProgress& progress) {
  if (Status status = check_options(options); !status.ok()) return status.error();
  if (Status status = check_mesh(source.mesh()); !status.ok()) return status.error();
  if (Status status = check_properties(source.properties(), source.mesh(), options.attribute_bits);
      !status.ok())
    return status.error();
  if (Status status = check_importance(options.importance, source.mesh(), source.skeleton()); !status.ok())
    return status.error();
  try {
    return push_all(source, options, sink, progress);
  } catch (const std::bad_alloc&) {
    return out_of_memory("there is not enough memory: use fewer frames per GOP or fewer threads");
  }
}

}  // namespace tvg
