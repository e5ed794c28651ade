#include "modes/elp_header.hpp"

#include "base/stream_error.hpp"
#include "container/numbers.hpp"

#include <algorithm>
#include <cmath>

namespace tvg {

namespace {

constexpr const char* kSection = "§4.5.1";
constexpr int kPredictors = 4;
constexpr Fault kShort{kSection, "the GOP's header is too short"};

/// Channel numbers in front of the other fields; all but the first may be unknown.
// format-spec §3.5, §4.5.1
Fault parse_channels(ByteReader& reader, Channels& channels) {
  const std::uint64_t count = reader.varint();
  if (!reader.ok() || count == 0 || count > Channels::kMost)
    return {kSection, "the number of the GOP's channels is out of range"};
  channels.count = static_cast<std::size_t>(count);
  AscendingNumbers ascending;
  bool unknown = false;
  for (std::size_t i = 0; i < channels.count; ++i) {
    const std::uint64_t channel = reader.varint();
    if (!reader.ok()) return kShort;
    if (i == 0 && channel != kPositionsChannel)
      return {kSection, "the first channel of a GOP is not positions"};
    if (!ascending.take(channel)) return {"§3.5", "the channels of a GOP do not ascend"};
    unknown = unknown || (i > 0 && is_required(channel));
    channels.numbers[i] = channel;
  }
  if (unknown)
    return {kSection, "the GOP has a channel that this decoder does not know", ErrorCode::kUnsupported};
  return {};
}

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
  if (const Fault fault = parse_channels(reader, elp.channels)) return fault;
  elp.predictors = PredictorSet(reader.u8());
  Lattice& lattice = elp.lattice;
  lattice.fine_bits = reader.u8();
  lattice.coarse_bits = reader.u8();
  for (double& coordinate : lattice.origin) coordinate = reader.f64();
  lattice.step = reader.f64();
  if (!reader.ok()) return kShort;
  if (elp.predictors.bits() >> kPredictors != 0)
    return {kSection, "the GOP has a predictor that this decoder does not know", ErrorCode::kUnsupported};
  if (!elp.predictors.has(Predictor::kSpace) && !elp.predictors.has(Predictor::kPyramid))
    return {kSection, "the GOP has no predictor for its first frame"};
  if (const Fault fault = fault_in(lattice)) return fault;
  elp.flags = reader.bytes(reader.left());
  if (!lattice.hybrid() && !elp.flags.empty()) return {kSection, "a GOP with one lattice carries flags"};
  return {};
}

}  // namespace

std::vector<std::uint8_t> write_elp_header(PredictorSet predictors, const Lattice& lattice, Bytes flags) {
  ByteWriter writer;
  writer.varint(1);
  writer.varint(kPositionsChannel);
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

// format-spec §4.5.2
Result<Bytes> positions_piece(const Channels& channels, Bytes packet) {
  ByteReader reader(packet);
  Bytes positions = packet;
  for (std::size_t i = 0; i + 1 < channels.count; ++i) {
    const Bytes piece = reader.bytes(reader.varint());
    if (i == 0) positions = piece;
  }
  if (!reader.ok()) return malformed("§4.5.2", "the pieces of a frame are longer than its packet");
  return positions;
}

std::vector<std::uint8_t> write_digest(std::uint64_t positions) {
  ByteWriter digest;
  digest.varint(kPositionsChannel);
  digest.u64(positions);
  return digest.take();
}

// format-spec §4.5.3
Result<std::uint64_t> read_digest(const Channels& channels, Bytes packet) {
  ByteReader reader(packet);
  std::uint64_t positions = 0;
  for (std::size_t i = 0; i < channels.count; ++i) {
    if (reader.varint() != channels.numbers[i])
      return malformed("§4.5.3", "the digests of a GOP are not those of its channels");
    const std::uint64_t digest = reader.u64();
    if (i == 0) positions = digest;
  }
  if (!reader.finished()) return malformed("§4.5.3", "the GOP's digest has a wrong size");
  return positions;
}

GopInfo gop_info(const GopHeader& header, const ElpHeader& elp) {
  GopInfo info;
  info.first_frame = header.first_frame;
  info.source_frame = header.first_frame;
  info.frame_count = header.frame_count;
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
