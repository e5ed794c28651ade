#include "corruption/repair.hpp"
#include "fuzz/require.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/join.hpp>
#include <tvg/relay.hpp>

namespace {

using tvg::Decoder;
using tvg::fuzz::require;
using Stream = std::vector<std::uint8_t>;

// Bits of the input's first byte.
constexpr std::uint8_t kRepairLengths = 1;
constexpr std::uint8_t kRepairChecksums = 2;
constexpr std::uint8_t kJoinTwice = 4;
constexpr std::uint8_t kJoinRange = 8;

tvg::DecoderLimits small_limits() {
  tvg::DecoderLimits limits;
  limits.vertices = 1u << 12;
  limits.faces = 1u << 13;
  limits.frames_per_gop = 1u << 8;
  limits.packet_bytes = 1u << 18;
  limits.meshes = 8;
  limits.mesh_bytes = 1u << 18;
  limits.plan_bytes = 1u << 18;
  limits.memory = std::uint64_t{32} << 20;
  return limits;
}

/// What a decoder says of a whole stream.
struct Verdict {
  std::vector<bool> told;  ///< [frame]: given out, or said to be lost, or both where a digest proves it wrong
  bool absurd = false;
  bool damaged = false;
  bool broken = false;  ///< decoding could not go on to the end

  bool valid() const { return !damaged && !broken; }
  void tell(std::uint64_t first, std::uint64_t count) {
    constexpr std::uint64_t kMost = 1u << 20;  // a damaged count may say anything
    absurd = absurd || first > kMost || count > kMost;
    if (absurd) return;
    if (told.size() < first + count) told.resize(first + count);
    for (std::uint64_t frame = first; frame < first + count; ++frame) told[frame] = true;
  }
};

Verdict verify(std::span<const std::uint8_t> stream) {
  Decoder decoder(small_limits());
  decoder.push(stream);
  decoder.finish();
  Verdict verdict;
  for (;;) {
    switch (decoder.poll()) {
      case Decoder::Event::kFrame:
        verdict.tell(decoder.frame_number(), 1);
        break;
      case Decoder::Event::kDamage:
        verdict.damaged = true;
        verdict.tell(decoder.damage().first_frame, decoder.damage().frame_count);
        break;
      case Decoder::Event::kError:
        verdict.broken = true;
        return verdict;
      case Decoder::Event::kEnd:
        return verdict;
      default:
        break;
    }
  }
}

tvg::ByteSink into(Stream& stream) {
  return [&stream](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return tvg::Status();
  };
}

tvg::JoinInput input_of(const Stream& stream) {
  return {"input",
          [rest = std::span<const std::uint8_t>(stream)](
              std::span<std::uint8_t> target) mutable -> tvg::Result<std::size_t> {
            const std::size_t count = std::min(rest.size(), target.size());
            if (count > 0) std::memcpy(target.data(), rest.data(), count);
            rest = rest.subspan(count);
            return count;
          }};
}

/// What join() and the relay make of a stream is one, and a valid one where the stream was. Neither decodes,
/// so packets with a right checksum and nonsense in them pass: their frames may be lost, the rest not.
void check_made(const Stream& made, std::uint64_t frames, bool from_valid) {
  const Verdict verdict = verify(made);
  require(!verdict.broken);
  require(verdict.valid() || !from_valid);
  if (verdict.absurd) {  // labels far apart, which tell how much is lost where packets are nonsense
    require(!from_valid);
    return;
  }
  require(verdict.told.size() >= frames);
  for (std::uint64_t frame = 0; frame < frames; ++frame) require(verdict.told[frame]);
  require(verdict.told.size() == frames || !from_valid);
}

void run_join(const Stream& stream, const Verdict& verdict, std::uint8_t options, std::uint8_t range) {
  std::vector<tvg::JoinInput> inputs;
  for (int i = 0; i < ((options & kJoinTwice) != 0 ? 2 : 1); ++i) inputs.push_back(input_of(stream));
  tvg::JoinOptions join_options;
  join_options.limits = small_limits();
  if ((options & kJoinRange) != 0) {
    join_options.frames = tvg::FrameRange{range % 16U, range % 16U + range / 16U};
  }
  Stream made;
  const auto report = tvg::join(std::move(inputs), join_options, into(made));
  if (report) check_made(made, report->frames, verdict.valid());
  if (!report) require(!report.error().message.empty());
  // Whatever the decoder calls valid can be joined.
  require(report || !verdict.valid() || join_options.frames);
}

void run_relay(const Stream& stream, std::size_t piece, const Verdict& verdict) {
  tvg::RelayLimits limits;
  limits.stream = small_limits();
  limits.chunk_bytes = 1u << 20;
  tvg::StreamSplitter splitter(limits);
  Stream made;
  tvg::StreamAssembler assembler(into(made));
  std::optional<tvg::StreamLimits> head;
  bool begun = false;
  bool ended = false;
  std::uint64_t frames = 0;
  tvg::Metadata metadata;
  const auto take = [&](const tvg::StreamPart& part) {
    require(!ended);
    if (part.kind == tvg::StreamPart::Kind::kHead) head = part.limits;
    if (part.kind == tvg::StreamPart::Kind::kMetadata) metadata = part.metadata;
    if (part.kind == tvg::StreamPart::Kind::kHead || part.kind == tvg::StreamPart::Kind::kMetadata) return;
    require(head.has_value());
    if (!begun) require(assembler.begin(*head, metadata).ok());
    begun = true;
    if (part.kind == tvg::StreamPart::Kind::kData) require(assembler.write_data(part.chunk).ok());
    if (part.kind == tvg::StreamPart::Kind::kMesh) require(assembler.write_mesh(part.chunk).ok());
    if (part.kind == tvg::StreamPart::Kind::kPlan) require(assembler.write_plan(part.chunk).ok());
    if (part.kind == tvg::StreamPart::Kind::kGop) {
      require(assembler.write_gop(part.chunk, part.frame_count).ok());
      frames += part.frame_count;
    }
    if (part.kind == tvg::StreamPart::Kind::kEnd) ended = true;
  };
  bool failed = false;
  for (std::span<const std::uint8_t> rest = stream; !rest.empty() && !failed;) {
    require(splitter.push(rest.first(std::min(piece, rest.size()))).ok());
    rest = rest.subspan(std::min(piece, rest.size()));
    for (;;) {
      const auto part = splitter.next();
      failed = !part;
      if (!part || !*part) break;
      take(**part);
    }
  }
  require(!verdict.valid() || (!failed && splitter.finish().ok()));
  // What came before a fault is passed on, as a live stream that breaks off is.
  if (!begun) return;
  require(assembler.end().ok());
  if (frames > 0) check_made(made, frames, verdict.valid());
}

}  // namespace

/// The input: a byte of options, a byte for the range of frames and the size of pieces, and a stream. With
/// the options' checksums repaired, damage gets past them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  Stream stream(data + 2, data + size);
  if ((data[0] & kRepairLengths) != 0) tvg::corruption::repair_lengths(stream);
  if ((data[0] & kRepairChecksums) != 0) tvg::corruption::repair_checksums(stream);
  const Verdict verdict = verify(stream);
  run_join(stream, verdict, data[0], data[1]);
  run_relay(stream, data[1] == 0 ? std::max<std::size_t>(stream.size(), 1) : data[1], verdict);
  return 0;
}
