#include "c_api/comparer_handle.hpp"
#include "c_api/encoder_handle.hpp"
#include "c_api/support.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tvg/measure.hpp>
#include <tvg/metrics.hpp>
#include <tvg/tvg.h>

// The C interface to the measure and to all figures of a comparison. Nothing throws out of here.

namespace {

using tvg::c_api::code_of;
using tvg::c_api::fail;
using tvg::c_api::give;
using tvg::c_api::guarded;
using tvg::c_api::write_text;

/// What the caller's structure has, as far as he knows it; nothing where its size is not set.
std::optional<tvg_importance> known_part(const tvg_importance* given) {
  tvg_importance known = {};
  known.struct_size = sizeof known;
  tvg_importance_init(&known);
  if (given == nullptr) return known;
  if (given->struct_size < sizeof(std::size_t)) return std::nullopt;
  std::memcpy(&known, given, std::min(given->struct_size, sizeof known));
  return known;
}

/// What is null although something is said to be there.
const char* fault_of(const tvg_importance& given) {
  if (given.criterion_count > 0 && given.criteria == nullptr) return "there are no criteria at null";
  for (const tvg_criterion& term : std::span(given.criteria, given.criterion_count)) {
    if (term.name == nullptr) return "a criterion has no name at null";
  }
  if (given.weight_count > 0 && given.weights == nullptr) return "there are no weights at null";
  return nullptr;
}

tvg::Importance importance_of(const tvg_importance& given) {
  tvg::Importance importance;
  if (given.criterion_count > 0) importance.criteria.clear();
  for (const tvg_criterion& term : std::span(given.criteria, given.criterion_count))
    importance.criteria.push_back({term.name, term.weight});
  importance.share = given.share;
  if (given.has_threshold != 0) importance.threshold = given.threshold;
  importance.smoothing = given.smoothing;
  importance.curv.alpha = given.curvature_alpha;
  std::copy_n(given.viewpoint, 3, importance.distance.viewpoint.begin());
  if (given.weight_count > 0) importance.weights.assign(given.weights, given.weights + given.weight_count);
  importance.low_delay = given.low_delay != 0;
  return importance;
}

std::vector<tvg::FramePositions> frames_of(const float* positions, std::size_t count, std::size_t values) {
  std::vector<tvg::FramePositions> frames(count);
  for (std::size_t f = 0; f < count; ++f)
    frames[f].assign(positions + f * values, positions + (f + 1) * values);
  return frames;
}

/// The measure asks what it stands on to be as sources and encoders check it.
tvg::Status check_geometry(const tvg::Mesh& mesh, std::span<const tvg::FramePositions> frames) {
  const auto refused = [](const char* text) {
    return tvg::Status(tvg::Error{tvg::ErrorCode::kInvalidInput, text});
  };
  for (const tvg::Face& face : mesh.faces) {
    for (const std::uint32_t corner : face) {
      if (corner >= mesh.vertex_count) return refused("a face names a vertex that the mesh does not have");
    }
  }
  for (const tvg::FramePositions& frame : frames) {
    if (!std::all_of(frame.begin(), frame.end(), [](float value) { return std::isfinite(value); }))
      return refused("a position is not finite");
  }
  return {};
}

}  // namespace

const char* tvg_criterion_name(size_t index) {
  try {
    const auto descriptions = tvg::criterion_descriptions();  // views of literals, which end in a zero
    return index < descriptions.size() ? descriptions[index].name.data() : nullptr;
  } catch (const std::exception&) {
    return nullptr;
  }
}

const char* tvg_criterion_description(size_t index) {
  try {
    const auto descriptions = tvg::criterion_descriptions();
    return index < descriptions.size() ? descriptions[index].description.data() : nullptr;
  } catch (const std::exception&) {
    return nullptr;
  }
}

tvg_code tvg_importance_init(tvg_importance* importance) {
  const tvg::Importance defaults;
  tvg_importance values = {};
  values.share = defaults.share;
  values.smoothing = defaults.smoothing;
  values.curvature_alpha = defaults.curv.alpha;
  return give(values, importance);
}

tvg_code tvg_encoder_set_importance(tvg_encoder* encoder, const tvg_importance* importance) {
  if (encoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  const std::optional<tvg_importance> given = known_part(importance);
  if (!given) return fail(*encoder, TVG_ERROR_INVALID_ARGUMENT, "the importance's struct_size is not set");
  if (const char* const fault = fault_of(*given)) return fail(*encoder, TVG_ERROR_INVALID_ARGUMENT, fault);
  if (encoder->encoder) return fail(*encoder, TVG_ERROR_WRONG_STATE, "there is a mesh already");
  return guarded(*encoder, [&] {
    encoder->options.importance = importance_of(*given);
    return tvg::Status();
  });
}

tvg_code tvg_measure(uint32_t vertex_count, const uint32_t* faces, uint32_t face_count,
                     const float* positions, size_t frame_count, const tvg_importance* importance,
                     double* costs, uint8_t* flags, char* error_text, size_t error_size) {
  const auto refused = [&](tvg_code code, const std::string& text) {
    write_text(text, error_text, error_size);
    return code;
  };
  write_text("", error_text, error_size);
  const std::size_t values = 3 * std::size_t{vertex_count};
  if (vertex_count == 0 || vertex_count > tvg::kMaxVertexCount || face_count > tvg::kMaxFaceCount ||
      (faces == nullptr && face_count > 0) || positions == nullptr || frame_count == 0 ||
      frame_count > SIZE_MAX / sizeof(float) / values)
    return refused(TVG_ERROR_INVALID_ARGUMENT, "there is no mesh or no frame to measure");
  const std::optional<tvg_importance> given = known_part(importance);
  if (!given) return refused(TVG_ERROR_INVALID_ARGUMENT, "the importance's struct_size is not set");
  if (const char* const fault = fault_of(*given)) return refused(TVG_ERROR_INVALID_ARGUMENT, fault);
  try {
    const tvg::Mesh mesh = tvg::c_api::mesh_of(vertex_count, faces, face_count);
    const std::vector<tvg::FramePositions> frames = frames_of(positions, frame_count, values);
    if (tvg::Status status = check_geometry(mesh, frames); !status.ok())
      return refused(code_of(status.error()), status.error().describe());
    const tvg::Result<tvg::Measure> made = tvg::measure(mesh, frames, {}, {}, importance_of(*given));
    if (!made) return refused(code_of(made.error()), made.error().describe());
    if (costs != nullptr) std::copy(made->cost.begin(), made->cost.end(), costs);
    if (flags != nullptr) std::copy(made->flags.begin(), made->flags.end(), flags);
    return TVG_OK;
  } catch (const std::exception&) {
    return refused(TVG_ERROR_OUT_OF_MEMORY, "out of memory");
  }
}

tvg_code tvg_comparer_use_hausdorff(tvg_comparer* comparer, uint32_t stride) {
  if (comparer == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  try {
    if (comparer->comparison.report().frames > 0) return TVG_ERROR_WRONG_STATE;
    comparer->comparison = tvg::SequenceComparison(comparer->mesh, {stride > 0, std::max(stride, 1u)});
    return TVG_OK;
  } catch (const std::exception&) {
    return TVG_ERROR_OUT_OF_MEMORY;
  }
}

tvg_code tvg_comparer_get_report(const tvg_comparer* comparer, tvg_comparison_report* report) {
  if (comparer == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  try {
    const tvg::ComparisonReport made = comparer->comparison.report();
    return give<tvg_comparison_report>({sizeof(tvg_comparison_report),
                                        made.frames,
                                        made.extent,
                                        made.diagonal,
                                        made.max_coordinate_error,
                                        made.rms_coordinate_error,
                                        made.mean_coordinate_error,
                                        made.max_vertex_distance,
                                        made.rms_vertex_distance,
                                        made.worst_frame,
                                        made.worst_vertex,
                                        made.snr_db,
                                        made.kg_percent,
                                        made.mean_quadric_error,
                                        made.max_quadric_error,
                                        made.sted,
                                        made.sted_spatial,
                                        made.sted_temporal,
                                        made.hausdorff_frames,
                                        made.hausdorff.value_or(0)},
                                       report);
  } catch (const std::exception&) {
    return TVG_ERROR_OUT_OF_MEMORY;
  }
}
