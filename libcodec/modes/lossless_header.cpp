#include "modes/lossless_header.hpp"

#include "base/stream_error.hpp"

namespace tvg {

namespace {

constexpr const char* kSection = "§4.5.1";
constexpr std::uint8_t kFloats = 0, kMultiples = 1;

// format-spec §4.5.1, §7.9.1
Fault parse(const GopHeader& header, LosslessHeader& lossless) {
  if (!header.planes.empty()) return {kSection, "a GOP in mode lossless names planes"};
  ByteReader reader(header.fields);
  if (const Fault fault = read_channels(reader, lossless.channels)) return fault;
  const std::uint8_t kind = reader.u8();
  const int amount = reader.u8();
  if (!reader.finished()) return {kSection, "the header of a GOP in mode lossless has a wrong size"};
  const bool known = kind == kFloats ? amount <= NumberLine::kMostLowBits
                                     : kind == kMultiples &&
                                           amount <= NumberLine::kMostExponent - NumberLine::kLeastExponent;
  if (!known) return {kSection, "the numbers of a GOP in mode lossless are out of range"};
  lossless.line = {.multiples = kind == kMultiples,
                   .low_bits = kind == kFloats ? amount : 0,
                   .exponent = kind == kMultiples ? amount + NumberLine::kLeastExponent : 0};
  return {};
}

}  // namespace

std::vector<std::uint8_t> write_lossless_header(const LineChoice& line) {
  ByteWriter writer;
  writer.u8(line.multiples ? kMultiples : kFloats);
  writer.u8(
      static_cast<std::uint8_t>(line.multiples ? line.exponent - NumberLine::kLeastExponent : line.low_bits));
  return writer.take();
}

Status read_lossless_header(const GopHeader& header, LosslessHeader& lossless) {
  const Fault fault = parse(header, lossless);
  return fault ? Status(error_of(fault)) : Status();
}

GopInfo lossless_gop_info(const GopHeader& header) {
  constexpr int kFloatBits = 32;
  GopInfo info = gop_info_of(header, Mode::kLossless);
  info.predictors[static_cast<std::size_t>(Predictor::kPyramid)] = true;
  info.fine_bits = info.coarse_bits = kFloatBits;
  return info;
}

}  // namespace tvg
