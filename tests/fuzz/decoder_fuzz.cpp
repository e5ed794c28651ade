#include "corruption/memory_meter.hpp"
#include "corruption/repair.hpp"
#include "fuzz/require.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tvg/decoder.hpp>

namespace {

using tvg::Decoder;
using tvg::fuzz::require;

// Bits of the input's first byte.
constexpr std::uint8_t kRepairLengths = 1;
constexpr std::uint8_t kRepairChecksums = 2;
constexpr std::uint8_t kMeasureBits = 4;
constexpr std::uint8_t kCopyWide = 8;
constexpr int kLodShift = 4;  // two bits

tvg::DecoderLimits small_limits() {
  tvg::DecoderLimits limits;
  limits.vertices = 1u << 15;
  limits.faces = 1u << 16;
  limits.frames_per_gop = 1u << 10;
  limits.packet_bytes = 1u << 20;
  limits.meshes = 8;
  limits.mesh_bytes = 1u << 18;
  limits.plan_bytes = 1u << 18;
  limits.memory = std::uint64_t{64} << 20;
  return limits;
}

/// What a player does with every event.
class Player {
 public:
  Player(const Decoder& decoder, bool wide) : decoder_(decoder), stride_(wide ? 20 : 12) {}

  void take_mesh() {
    const tvg::Mesh& mesh = decoder_.mesh();
    require(mesh.vertex_count > 0 && mesh.vertex_count <= decoder_.head().limits.vertices);
    require(mesh.faces.size() <= decoder_.head().limits.faces);
    for (const tvg::Face& face : mesh.faces) {
      for (const std::uint32_t v : face) require(v < mesh.vertex_count);
    }
    indices_.resize(3 * std::size_t{mesh.vertex_count});
    flags_.resize(mesh.vertex_count);
    positions_.resize(stride_ * mesh.vertex_count);
  }

  void take_frame() {
    require(!next_frame_ || decoder_.frame_number() >= *next_frame_);
    next_frame_ = decoder_.frame_number() + 1;
    decoder_.copy_positions(positions_.data(), stride_);
    decoder_.copy_lattice(indices_);
    decoder_.copy_flags(flags_);
    const tvg::GopInfo& gop = decoder_.gop();
    if (gop.mode == tvg::Mode::kLossless) {
      for (const std::int32_t number : indices_) require(number >= -0x7F800000 && number < 0x7F800000);
      return;
    }
    if (gop.mode == tvg::Mode::kBasis) {  // multiples of a step, of no lattice
      for (const std::int32_t multiple : indices_) require(multiple > INT32_MIN);
      return;
    }
    for (std::size_t i = 0; i < indices_.size(); ++i) {
      const int bits = flags_[i / 3] != 0 ? gop.fine_bits : gop.coarse_bits;
      require(indices_[i] >= 0 && indices_[i] < (std::int32_t{1} << bits));
    }
  }

 private:
  const Decoder& decoder_;
  std::size_t stride_;
  std::optional<std::uint64_t> next_frame_;
  std::vector<std::int32_t> indices_;
  std::vector<std::uint8_t> flags_, positions_;
};

/// Above this data are not unpacked, which takes memory that the head does not declare.
constexpr std::uint64_t kMostUnpacked = 1u << 20;

void take_data(const tvg::CodedData& data) {
  require(!data.name.empty() && data.name.size() <= tvg::kMaxDataNameBytes);
  require(data.decoded_size <= tvg::kMaxDataBytes && data.bytes.size() <= data.decoded_size);
  if (data.decoded_size > kMostUnpacked) return;
  const auto unpacked = tvg::unpack_data(data);
  require(!unpacked || unpacked->bytes.size() == data.decoded_size);
}

/// Decodes bytes pushed in pieces of `piece`. Returns the memory in bytes that this may take: what the head
/// declares, and what the player has.
std::size_t decode(std::span<const std::uint8_t> stream, std::size_t piece, std::uint8_t options) {
  Decoder decoder(small_limits());
  decoder.measure_bits((options & kMeasureBits) != 0);
  decoder.use_lod((options >> kLodShift) & 3u);
  Player player(decoder, (options & kCopyWide) != 0);
  std::size_t damages = 0;
  for (;;) {
    switch (decoder.poll()) {
      case Decoder::Event::kNeedBytes:
        if (stream.empty()) {
          decoder.finish();
          break;
        }
        decoder.push(stream.first(std::min(piece, stream.size())));
        stream = stream.subspan(std::min(piece, stream.size()));
        break;
      case Decoder::Event::kData:
        take_data(decoder.data());
        break;
      case Decoder::Event::kMesh:
        player.take_mesh();
        break;
      case Decoder::Event::kFrame:
        player.take_frame();
        break;
      case Decoder::Event::kDamage:
        require(!decoder.damage().error.message.empty());
        require(++damages < 1u << 16);
        break;
      case Decoder::Event::kEnd:
      case Decoder::Event::kError:
        return static_cast<std::size_t>(
                   std::max(decoder.head().limits.decoder_memory, tvg::decoder_memory_needed({}))) +
               80 * std::size_t{decoder.head().limits.vertices} + kMostUnpacked;
      default:
        break;
    }
  }
}

}  // namespace

/// The input: a byte of options, a byte that gives the size of the pieces (0: all at once), and a stream.
/// With the options' checksums repaired, damage gets past them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  std::vector<std::uint8_t> stream(data + 2, data + size);
  if ((data[0] & kRepairLengths) != 0) tvg::corruption::repair_lengths(stream);
  if ((data[0] & kRepairChecksums) != 0) tvg::corruption::repair_checksums(stream);
  const std::size_t piece = data[1] == 0 ? std::max<std::size_t>(stream.size(), 1) : data[1];
  const tvg::corruption::MemoryMeter meter;
  const std::size_t allowed = decode(stream, piece, data[0]);
  require(meter.peak() <= allowed + 4 * stream.size());
  return 0;
}
