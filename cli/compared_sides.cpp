#include "cli/compared_sides.hpp"

#include "cli/compared_properties.hpp"
#include "tool/progress.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace tvg::cli {

namespace {

/// The faces, whatever their order and whichever corner comes first: a stream does not keep either.
std::vector<Face> faces_of(const Mesh& mesh) {
  std::vector<Face> faces = mesh.faces;
  for (Face& face : faces) std::sort(face.begin(), face.end());
  std::sort(faces.begin(), faces.end());
  return faces;
}

bool same_connectivity(const Mesh& a, const Mesh& b) {
  return a.vertex_count == b.vertex_count && a.faces.size() == b.faces.size() && faces_of(a) == faces_of(b);
}

SourceStep read(FrameSource& source, FramePositions& frame) {
  const Result<SourceStep> step = read_step(source, frame);
  if (!step) throw tool_error(step.error());
  return *step;
}

/// Both sides, frame by frame, over changes of the mesh that both have.
class Comparing {
 public:
  Comparing(const ComparedSides& sides, const ComparisonSettings& settings)
      : sides_(sides),
        original_(*sides.original),
        decoded_(*sides.decoded),
        settings_(settings),
        bar_("comparing", sides.quiet) {}

  std::optional<std::vector<Stretch>> run() {
    for (;;) {
      if (!same_connectivity(original_.mesh(), decoded_.mesh())) return std::nullopt;
      const std::uint64_t first = frame_;
      SequenceComparison comparison(original_.mesh(), settings_);
      std::optional<ComparedProperties> properties;
      if (!sides_.same_properties) properties.emplace(original_, decoded_, sides_.decoded_name);
      const bool more = compare_stretch(comparison, properties);
      stretches_.push_back(
          {first, comparison.report(), properties ? properties->report() : PropertyReport()});
      if (!more) return std::move(stretches_);
    }
  }

 private:
  /// Compares up to the next mesh (true) or the end.
  bool compare_stretch(SequenceComparison& comparison, std::optional<ComparedProperties>& properties) {
    for (;; ++frame_) {
      const SourceStep a = read(original_, a_);
      const SourceStep b = read(decoded_, b_);
      if (a != b) fail_apart(a, b);
      if (a != SourceStep::kFrame) return a == SourceStep::kMesh;
      if (Status status = comparison.add_frame(a_, b_); !status.ok())
        throw tool_error(sides_.decoded_name, status.error());
      if (properties) properties->add_frame();
      bar_.update(frame_ + 1, original_.frame_count());
    }
  }

  [[noreturn]] void fail_apart(SourceStep a, SourceStep b) const {
    const std::string& ended = a == SourceStep::kEnd ? sides_.original_name : sides_.decoded_name;
    const std::string& goes_on = a == SourceStep::kEnd ? sides_.decoded_name : sides_.original_name;
    if (a == SourceStep::kEnd || b == SourceStep::kEnd) {
      throw ToolError(ExitStatus::kInvalidInput,
                      fmt::format("{} ends after {} frames, {} goes on", ended, frame_, goes_on));
    }
    throw ToolError(ExitStatus::kInvalidInput,
                    fmt::format("{} has another mesh from frame {} on, {} has not",
                                a == SourceStep::kMesh ? sides_.original_name : sides_.decoded_name, frame_,
                                a == SourceStep::kMesh ? sides_.decoded_name : sides_.original_name));
  }

  const ComparedSides& sides_;
  FrameSource& original_;
  FrameSource& decoded_;
  const ComparisonSettings settings_;
  ProgressBar bar_;
  FramePositions a_;
  FramePositions b_;
  std::uint64_t frame_ = 0;
  std::vector<Stretch> stretches_;
};

[[noreturn]] void fail_length(const ComparedSides& sides, bool original_ends, std::uint64_t frames) {
  throw ToolError(ExitStatus::kInvalidInput,
                  fmt::format("{} ends after {} frames, {} goes on",
                              original_ends ? sides.original_name : sides.decoded_name, frames,
                              original_ends ? sides.decoded_name : sides.original_name));
}

}  // namespace

std::optional<std::vector<Stretch>> compare_vertices(const ComparedSides& sides,
                                                     const ComparisonSettings& settings) {
  return Comparing(sides, settings).run();
}

ComparisonReport together(const std::vector<Stretch>& stretches) {
  ComparisonReport all = stretches[0].report;
  if (stretches.size() == 1) return all;
  double weights = 0;
  double squares = 0, vertex_squares = 0, means = 0, quadrics = 0;
  all.frames = 0;
  all.hausdorff_frames = 0;
  for (const Stretch& stretch : stretches) {
    const ComparisonReport& one = stretch.report;
    if (one.max_vertex_distance > all.max_vertex_distance || &stretch == &stretches[0]) {
      all.worst_frame = stretch.first_frame + one.worst_frame;
      all.worst_vertex = one.worst_vertex;
    }
    for (const auto figure :
         {&ComparisonReport::extent, &ComparisonReport::diagonal, &ComparisonReport::max_coordinate_error,
          &ComparisonReport::max_vertex_distance, &ComparisonReport::relative_max_coordinate_error,
          &ComparisonReport::relative_max_vertex_distance, &ComparisonReport::relative_rms_coordinate_error,
          &ComparisonReport::relative_rms_vertex_distance, &ComparisonReport::kg_percent,
          &ComparisonReport::max_quadric_error, &ComparisonReport::sted, &ComparisonReport::sted_spatial,
          &ComparisonReport::sted_temporal}) {
      all.*figure = std::max(all.*figure, one.*figure);
    }
    all.snr_db = std::min(all.snr_db, one.snr_db);
    all.vertices = std::max(all.vertices, one.vertices);
    all.frames += one.frames;
    all.hausdorff_frames += one.hausdorff_frames;
    if (one.hausdorff) all.hausdorff = std::max(all.hausdorff.value_or(0), *one.hausdorff);
    if (one.relative_hausdorff)
      all.relative_hausdorff = std::max(all.relative_hausdorff.value_or(0), *one.relative_hausdorff);
    const double weight = static_cast<double>(one.frames) * static_cast<double>(one.vertices);
    weights += weight;
    squares += weight * one.rms_coordinate_error * one.rms_coordinate_error;
    vertex_squares += weight * one.rms_vertex_distance * one.rms_vertex_distance;
    means += weight * one.mean_coordinate_error;
    quadrics += weight * one.mean_quadric_error;
  }
  all.rms_coordinate_error = std::sqrt(squares / weights);
  all.rms_vertex_distance = std::sqrt(vertex_squares / weights);
  all.mean_coordinate_error = means / weights;
  all.mean_quadric_error = quadrics / weights;
  return all;
}

SurfaceReport compare_surfaces(const ComparedSides& sides, const SurfaceSettings& settings) {
  SurfaceComparison comparison(sides.original->mesh(), sides.decoded->mesh(), settings);
  FramePositions a, b;
  ProgressBar bar("comparing", sides.quiet);
  for (std::uint64_t frame = 0;;) {
    SourceStep step_a, step_b;
    while ((step_a = read(*sides.original, a)) == SourceStep::kMesh)
      comparison.set_original(sides.original->mesh());
    while ((step_b = read(*sides.decoded, b)) == SourceStep::kMesh)
      comparison.set_other(sides.decoded->mesh());
    if (step_a != step_b) fail_length(sides, step_a == SourceStep::kEnd, frame);
    if (step_a == SourceStep::kEnd) return comparison.report();
    if (Status status = comparison.add_frame(a, b); !status.ok())
      throw tool_error(sides.decoded_name, status.error());
    bar.update(++frame, sides.original->frame_count());
  }
}

}  // namespace tvg::cli
