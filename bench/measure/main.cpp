#include "bench/measure/experiment.hpp"
#include "bench/measure/plot.hpp"
#include "bench/sequences.hpp"
#include "cli/measure_options.hpp"
#include "codecs/in_memory.hpp"
#include "codecs/timing.hpp"
#include "corpus/corpus.hpp"
#include "tool/atomic_file.hpp"
#include "tool/option_values.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>

// tvg_measure_bench: does marking by the measure pay, at equal size?
namespace tvg::bench {
namespace {

struct Settings {
  std::string data = default_data_folder();
  std::string folder;
  std::vector<std::string> sequences = {"chicken", "dance", "crane", "face", "hand"};
  std::string share = "35%";
  int coarser_bits = 2;
  double bits = 12.5;  ///< fine bits of the encoding by curv whose size all are compared at
  std::uint32_t seeds = 3;
  std::uint32_t gop_frames = 50;
  std::vector<std::string> measures;
  double alpha = 0.5;
  std::uint32_t smoothing = 0;
  bool extras = true;
  bool basis = false;

  Mode mode() const { return basis ? Mode::kBasis : Mode::kElp; }
};

struct Marks {
  std::string name;
  Importance importance;
};

Importance by(const Settings& settings, const std::string& criteria, double alpha, std::uint32_t smoothing) {
  Importance marks;
  marks.share = cli::parse_share(settings.share);
  marks.criteria = cli::parse_criteria(criteria);
  marks.curv.alpha = alpha;
  marks.smoothing = smoothing;
  return marks;
}

std::vector<Marks> usual_marks(const Settings& settings, const Experiment& experiment) {
  std::vector<Marks> marks = {{"curv", by(settings, "curv", 0.5, 0)},
                              {"curv, static", by(settings, "curv", 0, 0)},
                              {"curv, change", by(settings, "curv", 1, 0)},
                              {"change, smooth", by(settings, "curv", 1, 2)},
                              {"curvature-norm", by(settings, "curvature-norm", 0.5, 0)},
                              {"velocity", by(settings, "velocity", 0.5, 0)}};
  if (!experiment.joints) return marks;
  // SKEL has two values only, so a share would cut through equals: all vertices at dynamic joints are marked.
  Importance skel = by(settings, "skel", 0.5, 0);
  skel.threshold = 0.5;
  marks.push_back({"skel > 0.5", skel});
  marks.push_back({"curv+skel", by(settings, "curv+skel", 0.5, 0)});
  marks.push_back({"change+skel", by(settings, "curv+skel", 1, 0)});
  return marks;
}

std::vector<Marks> all_marks(const Settings& settings, const Experiment& experiment) {
  if (settings.measures.empty()) return usual_marks(settings, experiment);
  std::vector<Marks> marks = {{"curv", by(settings, "curv", 0.5, 0)}};
  for (const std::string& measure : settings.measures) {
    const Importance importance = by(settings, measure, settings.alpha, settings.smoothing);
    if (!uses_skeleton(importance) || experiment.joints) marks.push_back({measure, importance});
  }
  return marks;
}

/// The mean of curves of the same steps, point by point.
Curve mean_curve(const std::string& name, const std::vector<Curve>& curves) {
  Curve mean{name, curves[0].points};
  const auto count = static_cast<double>(curves.size());
  for (std::size_t p = 0; p < mean.points.size(); ++p) {
    mean.points[p].bytes = 0;
    mean.points[p].figures = {};
    for (const Curve& curve : curves) {
      mean.points[p].bytes += curve.points[p].bytes / count;
      for (std::size_t k = 0; k < kFigures; ++k) {
        mean.points[p].figures[k] += curve.points[p].figures[k] / count;
      }
    }
  }
  return mean;
}

struct Comparison {
  Curve uniform;
  std::vector<Curve> marked;  ///< the last one by lot
  double bytes = 0;           ///< where all are compared
  std::array<double, kFigures> sharing{};
};

Comparison compare_marks(const Settings& settings, const Experiment& experiment) {
  Comparison result;
  const double coarser = settings.coarser_bits;
  // Uniform encodings from the coarse lattice of the coarsest to the fine one of the finest.
  std::vector<double> uniform_bits;
  for (int half = -1 - 2 * settings.coarser_bits; half <= 1; ++half) {
    uniform_bits.push_back(settings.bits + 0.5 * half);
  }
  result.uniform = run_curve(experiment, "uniform", uniform_bits, std::nullopt);
  const std::vector<double> fine_bits = {settings.bits - 0.75, settings.bits, settings.bits + 0.75};
  for (const Marks& marks : all_marks(settings, experiment)) {
    result.marked.push_back(run_curve(experiment, marks.name, fine_bits, marks.importance));
  }
  std::vector<Curve> lots;
  for (std::uint32_t seed = 1; seed <= settings.seeds; ++seed) {
    const Importance marks = random_marks(experiment, cli::parse_share(settings.share), seed);
    lots.push_back(run_curve(experiment, "random", fine_bits, marks));
  }
  result.marked.push_back(mean_curve("random", lots));
  result.bytes = result.marked[0].points[1].bytes;
  const auto with_bits = [&result](double bits) {
    return *std::find_if(result.uniform.points.begin(), result.uniform.points.end(),
                         [bits](const Point& point) { return std::abs(point.bits - bits) < 1e-9; });
  };
  result.sharing =
      time_sharing(with_bits(settings.bits - coarser), with_bits(settings.bits), result.bytes).figures;
  return result;
}

void print_row(const std::string& name, const std::array<double, kFigures>& figures,
               const std::array<double, kFigures>& unit) {
  std::printf("| %s |", name.c_str());
  for (std::size_t k = 0; k < kFigures; ++k) std::printf(" %.3f |", figures[k] / unit[k]);
  std::printf("\n");
}

void print_comparison(const std::string& name, const Comparison& comparison) {
  const auto unit = comparison.uniform.at(comparison.bytes);
  std::printf("\n%s, %.1f kB; uniform bits: RMS %.5f %%, STED %.5f\n\n| marks |", name.c_str(),
              comparison.bytes / 1000, 100 * unit[kRms], unit[kSted]);
  for (const char* figure : kFigureNames) std::printf(" %s |", figure);
  std::printf("\n|---|---|---|---|---|---|\n");
  for (const Curve& curve : comparison.marked) print_row(curve.name, curve.at(comparison.bytes), unit);
  print_row("time-sharing", comparison.sharing, unit);
  std::fflush(stdout);
}

nlohmann::json json_of(const Curve& curve) {
  nlohmann::json points = nlohmann::json::array();
  for (const Point& point : curve.points) {
    nlohmann::json entry = {{"fine_bits", point.bits}, {"bytes", point.bytes}};
    for (std::size_t k = 0; k < kFigures; ++k) entry[kFigureNames[k]] = point.figures[k];
    points.push_back(std::move(entry));
  }
  return {{"marks", curve.name}, {"points", std::move(points)}};
}

nlohmann::json json_of(const Comparison& comparison) {
  nlohmann::json curves = {json_of(comparison.uniform)};
  for (const Curve& curve : comparison.marked) curves.push_back(json_of(curve));
  nlohmann::json table = nlohmann::json::object();
  const auto unit = comparison.uniform.at(comparison.bytes);
  const auto row = [&unit](const std::array<double, kFigures>& figures) {
    nlohmann::json result = nlohmann::json::object();
    for (std::size_t k = 0; k < kFigures; ++k) result[kFigureNames[k]] = figures[k] / unit[k];
    return result;
  };
  for (const Curve& curve : comparison.marked) table[curve.name] = row(curve.at(comparison.bytes));
  table["time-sharing"] = row(comparison.sharing);
  return {{"bytes", comparison.bytes}, {"relative_to_uniform", table}, {"curves", curves}};
}

void write_text(const std::string& path, const std::string& text) {
  cli::AtomicFile file(path);
  file.write(text);
  file.finish();
}

/// Plots show the curves that tell a story, or they could not be read.
std::vector<Curve> plotted(const std::vector<Curve>& curves) {
  std::vector<Curve> chosen;
  for (const Curve& curve : curves) {
    const bool left_out = curve.name == "curv, change" || curve.name == "curvature-norm" ||
                          curve.name == "skel > 0.5" || curve.name == "change+skel";
    if (!left_out) chosen.push_back(curve);
  }
  return chosen;
}

Experiment load_experiment(const Settings& settings, const std::string& name) {
  if (const corpus::CorpusEntry* entry = corpus::find_corpus_entry(name)) {
    corpus::CorpusSequence made = entry->make(*corpus::named_size("demo"));
    return prepare(name, std::move(made.sequence), std::move(made.joints), settings.gop_frames,
                   settings.coarser_bits, settings.mode());
  }
  return prepare(name, load(settings.data, name).sequence, std::nullopt, settings.gop_frames,
                 settings.coarser_bits, settings.mode());
}

/// How long the measure takes beside all of encoding.
void print_speed(const Experiment& experiment) {
  const Sequence& sequence = experiment.sequence;
  EncodeOptions options;
  options.fine_bits = 13;
  SequenceSource source(sequence);
  const double encoding = best_time([&] { encode_to_memory(source, options); });
  for (const CriterionDescription& criterion : criterion_descriptions()) {
    Importance importance;
    importance.criteria = {{std::string(criterion.name), 1.0}};
    if (!check_importance(importance, sequence.mesh, {}).ok()) continue;
    const double measuring = best_time([&] {
      for (std::size_t first = 0; first < sequence.frames.size(); first += options.gop_frames) {
        const std::size_t count = std::min<std::size_t>(options.gop_frames, sequence.frames.size() - first);
        const auto frames = std::span(sequence.frames).subspan(first, count);
        if (!measure(sequence.mesh, frames, {}, {}, importance)) throw std::runtime_error("measure failed");
      }
    });
    std::printf("%s: %s takes %.3f s, encoding with it %.3f s: %.0f %%\n", experiment.name.c_str(),
                importance.criteria[0].name.c_str(), measuring, encoding, 100 * measuring / encoding);
  }
}

struct HybridRow {
  int fine, coarse;
  double kilobytes;  ///< the paper's
};
constexpr std::array<HybridRow, 7> kPaperRows = {{{13, 13, 182.0},
                                                  {13, 11, 154.8},
                                                  {11, 11, 140.6},
                                                  {11, 9, 121.1},
                                                  {9, 9, 109.3},
                                                  {9, 7, 91.1},
                                                  {7, 7, 76.7}}};

std::size_t chicken_bytes(const Sequence& chicken, const HybridRow& row, double share) {
  EncodeOptions options;
  options.fine_bits = row.fine;
  options.coarse_bits = row.coarse;
  options.importance.share = share;
  SequenceSource source(chicken);
  return encode_to_memory(source, options).size();
}

/// Where the paper's hybrid sizes lie between those of their uniform neighbours, and with which share ours
/// do.
void print_paper_shares(const Sequence& chicken) {
  std::printf(
      "\nTable 1: how far a hybrid's size lies from its coarse towards its fine neighbour\n\n| bits | paper "
      "|");
  const std::vector<double> shares = {0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.5};
  for (const double share : shares) std::printf(" %.0f %% |", 100 * share);
  std::printf("\n|---|---|");
  for (std::size_t k = 0; k < shares.size(); ++k) std::printf("---|");
  std::printf("\n");
  std::vector<double> misfit(shares.size(), 0.0);
  for (std::size_t row = 1; row + 1 < kPaperRows.size(); row += 2) {
    const HybridRow &fine = kPaperRows[row - 1], &hybrid = kPaperRows[row], &coarse = kPaperRows[row + 1];
    const double paper = (hybrid.kilobytes - coarse.kilobytes) / (fine.kilobytes - coarse.kilobytes);
    const auto low = static_cast<double>(chicken_bytes(chicken, coarse, 0));
    const auto high = static_cast<double>(chicken_bytes(chicken, fine, 0));
    std::printf("| %d:%d | %.2f |", hybrid.fine, hybrid.coarse, paper);
    for (std::size_t k = 0; k < shares.size(); ++k) {
      const double ours =
          (static_cast<double>(chicken_bytes(chicken, hybrid, shares[k])) - low) / (high - low);
      misfit[k] += (ours - paper) * (ours - paper);
      std::printf(" %.2f |", ours);
    }
    std::printf("\n");
  }
  std::printf("| misfit, RMS | |");
  for (const double sum : misfit) std::printf(" %.2f |", std::sqrt(sum / 3));
  std::printf("\n");
}

void run_all(const Settings& settings) {
  if (!settings.folder.empty()) std::filesystem::create_directories(settings.folder);
  const std::vector<std::string> present = names_in(settings.data);
  nlohmann::json results = nlohmann::json::object();
  for (const std::string& name : settings.sequences) {
    if (corpus::find_corpus_entry(name) == nullptr &&
        std::find(present.begin(), present.end(), name) == present.end()) {
      std::printf("\n%s: not in %s, left out\n", name.c_str(), settings.data.c_str());
      continue;
    }
    const Experiment experiment = load_experiment(settings, name);
    const Comparison comparison = compare_marks(settings, experiment);
    print_comparison(name, comparison);
    results[name] = json_of(comparison);
    if (settings.extras && name == "crane") print_speed(experiment);
    if (settings.extras && name == "chicken") print_paper_shares(first_frames(experiment.sequence, 50));
    if (settings.folder.empty()) continue;
    for (const auto& [figure, suffix] : {std::pair(kRms, "rms"), std::pair(kDeforming, "deforming"),
                                         std::pair(kMoving, "moving"), std::pair(kSted, "sted")}) {
      write_text(settings.folder + "/" + name + "_" + suffix + ".svg",
                 plot_svg(name + ": " + kFigureNames[figure], comparison.uniform, plotted(comparison.marked),
                          figure, settings.coarser_bits));
    }
  }
  if (!settings.folder.empty()) write_text(settings.folder + "/measure.json", results.dump(2) + "\n");
}

}  // namespace
}  // namespace tvg::bench

int main(int argc, char** argv) {
  CLI::App app("Whether marking vertices by the measure pays, at equal size");
  tvg::bench::Settings settings;
  app.add_option("sequences", settings.sequences, "which ones: of --data or the corpus")
      ->capture_default_str();
  app.add_option("--data", settings.data, "folder of NAME.obj + NAME.pc2 (default: $TVG_DATA_DIR)");
  app.add_option("-o,--output", settings.folder, "folder for measure.json and the plots");
  app.add_option("--important", settings.share, "share of marked vertices")->capture_default_str();
  app.add_option("--coarser", settings.coarser_bits, "bits by which other vertices are coarser")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
  app.add_option("--bits", settings.bits, "fine bits of the encoding by curv that sets the size")
      ->check(CLI::Range(8.0, 15.0))
      ->capture_default_str();
  app.add_option("--seeds", settings.seeds, "draws of random marks")->check(CLI::Range(1U, 20U));
  app.add_option("--gop", settings.gop_frames, "frames per GOP")->check(CLI::Range(1U, 1000U));
  app.add_option("--measure", settings.measures,
                 "compare these measures with curv, in place of the usual ones; may be repeated")
      ->expected(1)
      ->take_all();
  app.add_option("--alpha", settings.alpha, "alpha of these")->check(CLI::Range(0.0, 1.0));
  app.add_option("--smooth", settings.smoothing, "how often the cost of these is averaged over neighbours");
  app.add_flag("--basis", settings.basis, "encode in mode basis, periods as long as a GOP");
  app.add_flag("!--only-marks", settings.extras, "neither speed nor Table 1");
  CLI11_PARSE(app, argc, argv);
  try {
    tvg::bench::run_all(settings);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tvg_measure_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
