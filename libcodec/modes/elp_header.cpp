#include "modes/elp_header.hpp"

#include "base/stream_error.hpp"

#include <algorithm>
#include <cmath>

namespace tvg {

namespace {

constexpr const char* kSection = "§4.5.1";
constexpr std::uint8_t kPredictors = 0b101111;  // all but rows
constexpr Fault kShort{kSection, "the GOP's header is too short"};

Fault fault_in(const Lattice& lattice) {
  if (lattice.coarse_bits < kMinBits || lattice.coarse_bits > lattice.fine_bits ||
      lattice.fine_bits > kMaxBits)
    return {kSection, "the GOP's bits are out of range"};
  const bool finite =
      std::all_of(lattice.origin.begin(), lattice.origin.end(), [](double x) { return std::isfinite(x); });
  if (!finite || !std::isfinite(lattice.step) || lattice.step <= 0)
    return {kSection, "the GOP's lattice has no finite origin or no positive step"};
  return {};
}

// format-spec §4.5.1
Fault parse(const GopHeader& header, ElpHeader& elp) {
  if (!header.planes.empty()) return {kSection, "a GOP in mode elp names planes"};
  ByteReader reader(header.fields);
  if (const Fault fault = read_channels(reader, elp.channels)) return fault;
  elp.predictors = PredictorSet(reader.u8());
  Lattice& lattice = elp.lattice;
  lattice.fine_bits = reader.u8();
  lattice.coarse_bits = reader.u8();
  for (double& coordinate : lattice.origin) coordinate = reader.f64();
  lattice.step = reader.f64();
  if (!reader.ok()) return kShort;
  if ((elp.predictors.bits() & ~kPredictors) != 0)
    return {kSection, "the GOP has a predictor that this decoder does not know", ErrorCode::kUnsupported};
  if (!elp.predictors.has(Predictor::kSpace) && !elp.predictors.has(Predictor::kPyramid) &&
      !elp.predictors.has(Predictor::kShape))
    return {kSection, "the GOP has no predictor for its first frame"};
  if (const Fault fault = fault_in(lattice)) return fault;
  elp.flags = reader.bytes(reader.left());
  if (!lattice.hybrid() && !elp.flags.empty()) return {kSection, "a GOP with one lattice carries flags"};
  return {};
}

}  // namespace

std::vector<std::uint8_t> write_elp_header(PredictorSet predictors, const Lattice& lattice, Bytes flags) {
  ByteWriter writer;
  writer.u8(predictors.bits());
  writer.u8(static_cast<std::uint8_t>(lattice.fine_bits));
  writer.u8(static_cast<std::uint8_t>(lattice.coarse_bits));
  for (const double coordinate : lattice.origin) writer.f64(coordinate);
  writer.f64(lattice.step);
  writer.bytes(flags);
  return writer.take();
}

Status read_elp_header(const GopHeader& header, ElpHeader& elp) {
  const Fault fault = parse(header, elp);
  return fault ? Status(error_of(fault)) : Status();
}

GopInfo gop_info(const GopHeader& header, const ElpHeader& elp) {
  GopInfo info = gop_info_of(header, Mode::kElp);
  for (std::size_t p = 0; p < info.predictors.size(); ++p)
    info.predictors[p] = elp.predictors.has(static_cast<Predictor>(p));
  info.fine_bits = elp.lattice.fine_bits;
  info.coarse_bits = elp.lattice.coarse_bits;
  info.origin = elp.lattice.origin;
  info.step = elp.lattice.step;
  info.flag_bytes = elp.flags.size();
  return info;
}

}  // namespace tvg
