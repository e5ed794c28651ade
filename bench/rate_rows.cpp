#include "bench/rate_rows.hpp"

#include "bench/rates.hpp"

#include <algorithm>
#include <cstdio>

namespace tvg::bench {

namespace {

std::vector<RateSetting> rows_of(const Sequence& sequence) {
  const auto whole = static_cast<std::uint32_t>(sequence.frames.size());
  std::vector<RateSetting> rows;
  const auto add = [&rows](RateSetting setting, const std::string& name) {
    setting.name = name;
    rows.push_back(std::move(setting));
  };
  add(basis_setting(whole, whole, 11), "basis, one period, B = 11");
  add(basis_setting(whole, whole, 9), "basis, one period, B = 9");
  if (whole > 64) add(basis_setting(64, 64, 11), "basis, period and GOP 64, 11");
  if (whole > 128) add(basis_setting(128, 32, 11), "basis, period 128, GOP 32, 11");
  add(elp_setting(Predictor::kElp, 32, 11), "elp, GOP 32, B = 11");
  add(elp_setting(Predictor::kAuto, 32, 11), "elp + auto, GOP 32, B = 11");
  add(elp_setting(Predictor::kAuto, 32, 13), "elp + auto, GOP 32, B = 13");
  add(lossless_setting(50), "lossless, GOP 50");
  return rows;
}

void print_row(const RateSetting& row, const RateResult& result, const Sequence& sequence) {
  const double vertices =
      static_cast<double>(sequence.mesh.vertex_count) * static_cast<double>(sequence.frames.size()) / 1e6;
  const double steady = result.decode.planes + result.decode.frames;
  const double rms = result.lattice_rms > 0 ? result.errors.rms_coordinate_error / result.lattice_rms : 0.0;
  std::printf("  %-30s %9llu %7.3f %7.3f %8.4f %8.4f %8.2f %8.1f %8.1f %8.1f %8.1f %8.1f\n", row.name.c_str(),
              static_cast<unsigned long long>(result.bytes),
              bits_per_coordinate(result.bytes, sequence.mesh.vertex_count, sequence.frames.size()), rms,
              100 * result.errors.relative_max_coordinate_error, 100 * result.errors.sted,
              vertices / result.encode_seconds, vertices / result.decode.all(), vertices / steady,
              1000 * result.decode.mesh, 1000 * result.decode.planes, 1000 * result.decode.frames);
  std::fflush(stdout);
}

}  // namespace

void print_rate_rows(const NamedSequence& named) {
  std::printf("%s, modes of TVG\n  %-30s %9s %7s %7s %8s %8s %8s %8s %8s %8s %8s %8s\n", named.name.c_str(),
              "", "bytes", "bpc", "RMS/lat", "max %", "100 STED", "enc Mv/s", "dec Mv/s", "steady", "mesh ms",
              "plans ms", "frame ms");
  for (const RateSetting& row : rows_of(named.sequence)) {
    print_row(row, run_rate(named.sequence, row.options), named.sequence);
  }
}

}  // namespace tvg::bench
