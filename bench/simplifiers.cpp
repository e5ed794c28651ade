#include "bench/other_simplifiers.hpp"
#include "bench/sequences.hpp"
#include "codecs/timing.hpp"
#include "corpus/corpus.hpp"
#include "tool/atomic_file.hpp"
#include "tool/line_plot.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>

#include <tvg/geometry.hpp>
#include <tvg/metrics.hpp>

// tvg_simplifiers: MAPS and the measure in its place beside simplifiers that see the first frame alone, at
// the same number of vertices.
namespace tvg::bench {
namespace {

constexpr std::array<double, 2> kRatios = {2.5, 6};
/// Frames at which distances and faults are measured, evenly spread.
constexpr std::size_t kMeasuredFrames = 20;

struct Animation {
  std::string name;
  Sequence sequence;
  std::optional<JointTracks> joints;
};

/// The paper's Eq. 8 in every frame, as SimplifyLevel::quadric_error has it.
std::vector<double> quadric_errors(const Sequence& sequence, const SimplifiedMesh& simplified) {
  using Eigen::Vector3d;
  std::vector<bool> stays(sequence.mesh.vertex_count, false);
  for (const std::uint32_t v : simplified.vertices) stays[v] = true;
  const double scale = 1 / box_around(sequence.frames).largest_extent();
  std::vector<double> errors;
  for (const FramePositions& frame : sequence.frames) {
    FramePositions kept, placed(frame.size());
    for (const std::uint32_t v : simplified.vertices)
      kept.insert(kept.end(), frame.begin() + 3 * std::ptrdiff_t{v},
                  frame.begin() + 3 * std::ptrdiff_t{v} + 3);
    positions_of(simplified.mesh, simplified.places, kept, placed);
    const auto at = [](const FramePositions& positions, std::uint32_t v) {
      return Vector3d(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
    };
    double sum = 0;
    for (const auto& [a, b, c] : sequence.mesh.faces) {
      Vector3d normal = (at(frame, b) - at(frame, a)).cross(at(frame, c) - at(frame, a));
      if (!(normal.norm() > 0)) continue;
      normal.normalize();
      for (const std::uint32_t v : {a, b, c}) {
        if (stays[v]) continue;
        const double distance = scale * normal.dot(at(placed, v) - at(frame, v));
        sum += distance * distance;
      }
    }
    errors.push_back(sum);
  }
  return errors;
}

/// What a simplification is worth.
struct Row {
  std::string name;
  std::uint32_t vertices = 0;
  std::vector<double> quadric;  ///< [frame]
  SurfaceReport distance;
  std::int64_t crossings = 0, folds = 0;  ///< that the original has not, over the frames measured
  double seconds = 0;

  double mean_quadric() const {
    double sum = 0;
    for (const double error : quadric) sum += error;
    return sum / static_cast<double>(quadric.size());
  }
};

Row row_of(const std::string& name, const Sequence& sequence, const SimplifiedMesh& simplified,
           double seconds) {
  Row row{name, simplified.mesh.vertex_count, quadric_errors(sequence, simplified), {}, 0, 0, seconds};
  const std::size_t stride = (sequence.frames.size() + kMeasuredFrames - 1) / kMeasuredFrames;
  SurfaceComparison comparison(sequence.mesh, simplified.mesh,
                               {SurfaceSettings().samples, static_cast<std::uint32_t>(stride)});
  for (std::size_t f = 0; f < sequence.frames.size(); ++f) {
    const FramePositions& frame = sequence.frames[f];
    FramePositions kept;
    for (const std::uint32_t v : simplified.vertices)
      kept.insert(kept.end(), frame.begin() + 3 * std::ptrdiff_t{v},
                  frame.begin() + 3 * std::ptrdiff_t{v} + 3);
    if (const Status status = comparison.add_frame(frame, kept); !status.ok())
      throw cli::tool_error(name, status.error());
    if (f % stride != 0) continue;
    const Result<SurfaceFaults> before = surface_faults(sequence.mesh, frame);
    const Result<SurfaceFaults> after = surface_faults(simplified.mesh, kept);
    if (!before || !after) throw cli::tool_error(name, before ? after.error() : before.error());
    row.crossings += std::max<std::int64_t>(0, static_cast<std::int64_t>(after->intersections) -
                                                   static_cast<std::int64_t>(before->intersections));
    row.folds += std::max<std::int64_t>(
        0, static_cast<std::int64_t>(after->folds) - static_cast<std::int64_t>(before->folds));
  }
  row.distance = comparison.report();
  return row;
}

Row ours(const Animation& animation, const std::string& name, std::uint32_t vertices) {
  SimplifyOptions options;
  options.vertex_counts = {vertices};
  if (name == "maps") options.priority = SimplifyPriority::kMaps;
  options.importance.criteria.clear();
  if (name != "skel") options.importance.criteria.push_back({"curv", 1});
  if (name == "skel" || name == "curv+skel") options.importance.criteria.push_back({"skel", 1});
  const Skeleton none;
  const bool joints = uses_skeleton(options.importance);
  const double start = processor_seconds();
  Result<Simplification> made =
      simplify(animation.sequence.mesh, animation.sequence.frames, joints ? animation.joints->skeleton : none,
               joints ? std::span<const std::vector<float>>(animation.joints->frames)
                      : std::span<const std::vector<float>>(),
               options);
  const double seconds = processor_seconds() - start;
  if (!made) throw cli::tool_error(animation.name, made.error());
  return row_of(name, animation.sequence, made->meshes.back(), seconds);
}

template <class Simplifier>
Row theirs(const Animation& animation, const std::string& name, std::uint32_t vertices,
           Simplifier simplifier) {
  const double start = processor_seconds();
  std::vector<Face> faces = simplifier(animation.sequence.mesh, animation.sequence.frames.front(), vertices);
  const double seconds = processor_seconds() - start;
  const SimplifiedMesh made = mesh_of(std::move(faces), animation.sequence.frames.front());
  return row_of(name, animation.sequence, made, seconds);
}

std::vector<Row> rows_of(const Animation& animation, std::uint32_t vertices) {
  std::vector<Row> rows = {ours(animation, "maps", vertices), ours(animation, "curv", vertices)};
  if (animation.joints) {
    rows.push_back(ours(animation, "skel", vertices));
    rows.push_back(ours(animation, "curv+skel", vertices));
  }
  rows.push_back(theirs(animation, "OpenMesh, first frame", vertices, decimate_openmesh));
  rows.push_back(theirs(animation, "meshoptimizer, first frame", vertices, simplify_meshoptimizer));
  return rows;
}

void print(const Animation& animation, double ratio, const std::vector<Row>& rows) {
  std::printf("\n%s, ratio %g: %u vertices, %zu frames\n\n", animation.name.c_str(), ratio,
              animation.sequence.mesh.vertex_count, animation.sequence.frames.size());
  std::printf(
      "| | vertices | quadric error | RMS, %% | Hausdorff, %% | worst frame, %% | new crossings | new folds "
      "| "
      "s |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const Row& row : rows) {
    std::printf("| %s | %u | %.4f | %.4f | %.3f | %.3f | %lld | %lld | %.2f |\n", row.name.c_str(),
                row.vertices, row.mean_quadric(), 100 * row.distance.relative_rms,
                100 * row.distance.relative_mean_hausdorff, 100 * row.distance.relative_hausdorff,
                static_cast<long long>(row.crossings), static_cast<long long>(row.folds), row.seconds);
  }
  std::fflush(stdout);
}

/// The paper's Figure 1(b).
void write_plot(const std::string& folder, const Animation& animation, double ratio,
                const std::vector<Row>& rows) {
  std::filesystem::create_directories(folder);
  cli::LinePlot plot{animation.name + ": quadric error at ratio " + (ratio == 6 ? "6" : "2.5"),
                     {"frame"},
                     {"quadric error"},
                     {},
                     false};
  for (const Row& row : rows) {
    if (row.name.find("frame") != std::string::npos) continue;
    cli::PlotCurve curve{row.name == "maps" ? "MAPS" : "MAPS + " + row.name, {}};
    for (std::size_t f = 0; f < row.quadric.size(); ++f)
      curve.points.emplace_back(static_cast<double>(f), row.quadric[f]);
    plot.curves.push_back(std::move(curve));
  }
  cli::AtomicFile file(folder + "/" + animation.name + (ratio == 6 ? "_6.svg" : "_2.5.svg"));
  file.write(cli::plot_svg({plot}));
  file.finish();
}

void run(const std::string& data, const std::string& folder, const std::vector<std::string>& wanted) {
  std::vector<Animation> animations;
  const auto is_wanted = [&wanted](const std::string& name) {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
  };
  for (const std::string& name : names_in(data)) {
    if (is_wanted(name)) animations.push_back({name, load(data, name).sequence, std::nullopt});
  }
  for (const char* name : {"face", "hand"}) {
    if (!is_wanted(name)) continue;
    corpus::CorpusSequence made = corpus::find_corpus_entry(name)->make(*corpus::named_size("demo"));
    animations.push_back({name, std::move(made.sequence), std::move(made.joints)});
  }
  for (const Animation& animation : animations) {
    for (const double ratio : kRatios) {
      const auto vertices =
          static_cast<std::uint32_t>(std::lround(animation.sequence.mesh.vertex_count / ratio));
      const std::vector<Row> rows = rows_of(animation, vertices);
      print(animation, ratio, rows);
      if (!folder.empty()) write_plot(folder, animation, ratio, rows);
    }
  }
}

}  // namespace
}  // namespace tvg::bench

int main(int argc, char** argv) {
  CLI::App app("Simplifiers of animations at the same number of vertices");
  std::string data = tvg::bench::default_data_folder();
  std::string folder;
  std::vector<std::string> names;
  app.add_option("--data", data, "folder of NAME.obj + NAME.pc2 (default: $TVG_DATA_DIR)");
  app.add_option("-o,--output", folder, "folder for plots of the quadric error of each frame");
  app.add_option("names", names, "sequences of it, face and hand (default: all)");
  CLI11_PARSE(app, argc, argv);
  try {
    tvg::bench::run(data, folder, names);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tvg_simplifiers: %s\n", error.what());
    return 1;
  }
  return 0;
}
