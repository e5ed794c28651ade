#include "bench/rate_rows.hpp"
#include "bench/sequences.hpp"
#include "bench/tvg_codec.hpp"
#include "codecs/other_codecs.hpp"
#include "corpus/corpus.hpp"

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>

// tvg_bench: (a) the paper's Table 1 beside ours, (b) other codecs on the same lattice. bench/README.md says
// what the figures mean.
namespace tvg::bench {
namespace {

/// Table 1 of the paper: chicken, 50 frames, ELP.
struct PaperRow {
  int fine_bits;
  int coarse_bits;
  double kilobytes;
};
constexpr std::array<PaperRow, 7> kPaperTable = {{{13, 13, 182.0},
                                                  {13, 11, 154.8},
                                                  {11, 11, 140.6},
                                                  {11, 9, 121.1},
                                                  {9, 9, 109.3},
                                                  {9, 7, 91.1},
                                                  {7, 7, 76.7}}};
constexpr std::size_t kPaperFrames = 50;
/// The paper does not say which share it marked. Ours by default, and the one that fits its file sizes best
/// (bench/measure).
constexpr std::array<double, 2> kShares = {0.35, 0.15};

double million_per_second(double count, double seconds) {
  return count / seconds / 1e6;
}

std::string machine() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown CPU";
}

void print_paper_row(const Sequence& sequence, const PaperRow& row, double share) {
  TvgSettings settings;
  settings.fine_bits = row.fine_bits;
  settings.coarse_bits = row.coarse_bits;
  settings.important_share = share;
  settings.gop_frames = kPaperFrames;
  const TvgResult result = run_tvg(sequence, settings);
  const auto bytes = static_cast<double>(result.codec.bytes);
  const bool hybrid = row.fine_bits != row.coarse_bits;
  const std::string bits =
      std::to_string(row.fine_bits) + (hybrid ? "-" + std::to_string(row.coarse_bits) : "");
  const std::string marked = hybrid ? std::to_string(std::lround(100 * share)) + " %" : "";
  std::printf("%6s %6s %9.1f %9zu %9.1f %10.3f %10.3f %7.3f %7.2f\n", bits.c_str(), marked.c_str(),
              row.kilobytes, result.codec.bytes, bytes / 1000, bytes / (1000 * row.kilobytes),
              bytes / (1024 * row.kilobytes),
              bits_per_coordinate(result.codec.bytes, sequence.mesh.vertex_count, sequence.frames.size()),
              compare(sequence, result.frames).snr_db);
}

void print_paper_table(const Sequence& chicken) {
  const Sequence sequence = first_frames(chicken, kPaperFrames);
  std::printf("The paper's Table 1: chicken, first %zu frames, predictor elp\n", sequence.frames.size());
  std::printf("%6s %6s %9s %9s %9s %10s %10s %7s %7s\n", "bits", "share", "paper KB", "bytes", "ours KB",
              "/paper1000", "/paper1024", "bpc", "SNR dB");
  for (const PaperRow& row : kPaperTable) {
    if (row.fine_bits == row.coarse_bits) {
      print_paper_row(sequence, row, kShares.front());
      continue;
    }
    for (const double share : kShares) print_paper_row(sequence, row, share);
  }
  std::printf(
      "(/paper1000, /paper1024: our bytes over the paper's, its KB taken as 1000 or as 1024 bytes)\n\n");
}

void print_codec(const CodecResult& codec, const LatticeSequence& lattice, const ComparisonReport& errors) {
  std::printf("  %-28s %9zu %7.3f %9.2f %9.2f %9.5f %9.5f  %s\n", codec.name.c_str(), codec.bytes,
              bits_per_coordinate(codec.bytes, lattice.mesh.vertex_count, lattice.frames.size()),
              million_per_second(lattice.vertices(), codec.encode_seconds),
              million_per_second(lattice.vertices(), codec.decode_seconds),
              100 * errors.relative_max_coordinate_error, 100 * errors.relative_rms_coordinate_error,
              codec.exact ? "yes" : "NO");
  std::fflush(stdout);
}

void print_codecs(const NamedSequence& named, int bits) {
  const Lattice lattice = quantize(named.sequence, bits);
  std::printf("%s: %u vertices, %zu faces, %zu frames\n", named.name.c_str(),
              named.sequence.mesh.vertex_count, named.sequence.mesh.faces.size(),
              named.sequence.frames.size());
  std::printf("  %-28s %9s %7s %9s %9s %9s %9s  %s\n", "", "bytes", "bpc", "enc Mv/s", "dec Mv/s", "max %",
              "RMS %", "exact");
  TvgSettings settings;
  settings.fine_bits = settings.coarse_bits = bits;
  const TvgResult ours = run_tvg(named.sequence, settings);
  print_codec(ours.codec, lattice.indices, compare(named.sequence, ours.frames));
  const ComparisonReport errors = compare(named.sequence, lattice.centres());
  CodecResult draco;
  for (const OtherCodec& codec : other_codecs()) {
    const CodecResult result = codec.run(lattice.indices, kUsualRuns);
    if (codec.run == run_draco) draco = result;
    print_codec(result, lattice.indices, errors);
  }
  std::printf("  decoding: %.1f times Draco's speed\n", draco.decode_seconds / ours.codec.decode_seconds);
}

void run(const std::string& folder, int bits) {
  std::printf("%s, one thread\n\n", machine().c_str());
  const std::vector<std::string> names = names_in(folder);
  const bool has_chicken = std::find(names.begin(), names.end(), "chicken") != names.end();
  if (has_chicken) {
    print_paper_table(load(folder, "chicken").sequence);
  } else {
    std::printf("No chicken.obj and chicken.pc2 in %s: the paper's Table 1 is left out.\n", folder.c_str());
  }
  std::printf(
      "Codecs on the same lattice, B = %d (TVG: GOPs of %u frames). Errors: of a coordinate, in percent of "
      "the "
      "bounding box's diagonal.\n",
      bits, TvgSettings{}.gop_frames);
  for (const std::string& name : names) {
    const NamedSequence named = load(folder, name);
    print_codecs(named, bits);
    print_rate_rows(named);
  }
  if (!names.empty()) return;
  std::printf("No sequences in %s: the project's own are used instead.\n", folder.c_str());
  for (const corpus::CorpusEntry& entry : corpus::corpus_entries()) {
    print_codecs({std::string(entry.name), entry.make(*corpus::named_size("demo")).sequence}, bits);
  }
}

}  // namespace
}  // namespace tvg::bench

int main(int argc, char** argv) {
  CLI::App app("Side-by-side comparison of TVG with the paper and with other codecs");
  std::string folder = tvg::bench::default_data_folder();
  int bits = 11;
  app.add_option("--data", folder, "folder of NAME.obj + NAME.pc2 (default: $TVG_DATA_DIR)");
  app.add_option("--bits", bits, "bits of the lattice in the comparison of codecs")->check(CLI::Range(7, 16));
  CLI11_PARSE(app, argc, argv);
  try {
    tvg::bench::run(folder, bits);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tvg_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
