#include "bench/published_rates.hpp"
#include "bench/rates.hpp"
#include "bench/sequences.hpp"
#include "codecs/other_codecs.hpp"
#include "tool/atomic_file.hpp"
#include "tool/line_plot.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>

// tvg_rate_plots: bits per vertex and frame against error, TVG's modes beside other codecs, as SVGs and a
// table.
namespace tvg::bench {
namespace {

constexpr std::array<int, 3> kBits = {9, 11, 13};

struct Measured {
  double rate = 0;  ///< bits per vertex and frame
  double kg = 0;    ///< percent
  double rms = 0;   ///< of a coordinate, percent of the diagonal
};

struct MeasuredCurve {
  std::string name;
  std::vector<Measured> points;
};

Measured measured(const ComparisonReport& errors, double rate) {
  return {rate, errors.kg_percent, 100 * errors.relative_rms_coordinate_error};
}

/// A setting as it is at so many bits.
MeasuredCurve curve_of(const Sequence& sequence, RateSetting setting) {
  MeasuredCurve curve{setting.name, {}};
  for (const int bits : kBits) {
    setting.options.fine_bits = setting.options.coarse_bits = bits;
    const RateResult result = run_rate(sequence, setting.options);
    curve.points.push_back(measured(
        result.errors,
        bits_per_vertex_and_frame(result.bytes, sequence.mesh.vertex_count, sequence.frames.size())));
  }
  return curve;
}

std::vector<MeasuredCurve> curves_of(const NamedSequence& named) {
  const Sequence& sequence = named.sequence;
  const auto whole = static_cast<std::uint32_t>(sequence.frames.size());
  std::vector<MeasuredCurve> curves = {curve_of(sequence, elp_setting(Predictor::kElp, 32, 11)),
                                       curve_of(sequence, elp_setting(Predictor::kAuto, 32, 11)),
                                       curve_of(sequence, basis_setting(32, 32, 11)),
                                       {"basis, period 128", {}}};
  if (whole > 128) curves.back() = curve_of(sequence, basis_setting(128, 32, 11));
  curves.push_back(curve_of(sequence, basis_setting(whole, whole, 11)));
  curves.back().name = "basis, period whole";

  MeasuredCurve draco{"Draco", {}}, deltas{"meshoptimizer", {}}, famc{"FAMC", {}}, vdmc{"V-DMC", {}};
  for (const int bits : kBits) {
    const Lattice lattice = quantize(sequence, bits);
    const ComparisonReport errors = compare(sequence, lattice.centres());
    const auto add = [&](MeasuredCurve& curve, const CodecResult& result) {
      curve.points.push_back(measured(
          errors,
          bits_per_vertex_and_frame(result.bytes, sequence.mesh.vertex_count, sequence.frames.size())));
    };
    add(draco, run_draco(lattice.indices));
    add(deltas, run_meshoptimizer(lattice.indices));
    for (const PublishedRate& published : kPublishedRates) {
      if (published.sequence != named.name || published.bits != bits) continue;
      MeasuredCurve& curve = published.codec == "FAMC" ? famc : vdmc;
      curve.points.push_back(measured(errors, 3 * published.bits_per_coordinate));
    }
  }
  curves.insert(curves.end(), {draco, deltas, famc, vdmc});
  return curves;
}

void print_table(const std::string& name, const std::vector<MeasuredCurve>& curves) {
  std::printf("\n%s\n\n| | bpvf | KG, %% | RMS, %% |\n|---|---|---|---|\n", name.c_str());
  for (const MeasuredCurve& curve : curves) {
    for (const Measured& point : curve.points) {
      std::printf("| %s | %.3f | %.4f | %.5f |\n", curve.name.c_str(), point.rate, point.kg, point.rms);
    }
  }
  std::fflush(stdout);
}

void write_picture(const std::string& path, const std::string& title, const std::string& label,
                   const std::vector<MeasuredCurve>& curves, double Measured::*error) {
  cli::LinePlot plot{title + ": bits per vertex and frame, whole file", {label, true}, {"", true}, {}};
  for (const MeasuredCurve& curve : curves) {
    cli::PlotCurve line{curve.name, {}};
    for (const Measured& point : curve.points) line.points.emplace_back(point.*error, point.rate);
    plot.curves.push_back(std::move(line));
  }
  cli::AtomicFile file(path);
  file.write(cli::plot_svg({plot}));
  file.finish();
}

void run(const std::string& data, const std::string& folder) {
  std::filesystem::create_directories(folder);
  for (const std::string& name : names_in(data)) {
    const std::vector<MeasuredCurve> curves = curves_of(load(data, name));
    print_table(name, curves);
    write_picture(folder + "/" + name + "_kg.svg", name, "KG error, percent", curves, &Measured::kg);
    write_picture(folder + "/" + name + "_rms.svg", name, "RMS of a coordinate, percent of the diagonal",
                  curves, &Measured::rms);
  }
}

}  // namespace
}  // namespace tvg::bench

int main(int argc, char** argv) {
  CLI::App app("Bits per vertex and frame against error, as SVGs and tables");
  std::string data = tvg::bench::default_data_folder();
  std::string folder = "bench/plots";
  app.add_option("--data", data, "folder of NAME.obj + NAME.pc2 (default: $TVG_DATA_DIR)");
  app.add_option("-o,--output", folder, "folder for the pictures")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    tvg::bench::run(data, folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tvg_rate_plots: %s\n", error.what());
    return 1;
  }
  return 0;
}
