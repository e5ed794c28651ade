#include "judge.hpp"

#include "base/checksum.hpp"
#include "memory_meter.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <tvg/decoder.hpp>

namespace tvg::corruption {

namespace {

constexpr std::size_t kRoom = 4096;  ///< entries; reserved before memory is measured

std::span<const std::uint8_t> bytes_of(const auto& values) {
  return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof values[0]};
}

/// Takes frames out of a decoder and digests them, with buffers from before the measurement.
class Eye {
 public:
  Eye() {
    indices_.reserve(3 * kRoom);
    positions_.reserve(3 * kRoom);
  }

  std::uint64_t digest(const Decoder& decoder) {
    indices_.resize(3 * std::size_t{decoder.mesh().vertex_count});
    positions_.resize(indices_.size());
    decoder.copy_lattice(indices_);
    decoder.copy_positions(positions_.data());
    Hasher hash;
    hash.update(indices_);
    hash.update(bytes_of(positions_));
    hash.update(bytes_of(decoder.mesh().faces));
    return hash.value();
  }

 private:
  std::vector<std::int32_t> indices_;
  std::vector<float> positions_;
};

}  // namespace

Original make_original(std::string_view conformance_stream) {
  Original original;
  const std::size_t at = conformance_stream.find('@');
  if (at != std::string_view::npos)
    original.lod = static_cast<std::uint32_t>(std::stoul(std::string(conformance_stream.substr(at + 1))));
  std::ifstream file(std::filesystem::path(TVG_CONFORMANCE_FOLDER) /
                         (std::string(conformance_stream.substr(0, at)) + ".tvg"),
                     std::ios::binary);
  original.stream.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  Decoder decoder;
  decoder.use_lod(original.lod);
  decoder.push(original.stream);
  decoder.finish();
  Eye eye;
  for (;;) {
    const Decoder::Event event = decoder.poll();
    if (event == Decoder::Event::kFrame) original.frames.push_back(eye.digest(decoder));
    if (event == Decoder::Event::kEnd) break;
    if (event == Decoder::Event::kError || event == Decoder::Event::kDamage) std::abort();
  }
  original.declared_memory = decoder.head().limits.decoder_memory;
  return original;
}

bool Verdict::reported(std::uint64_t frame) const {
  return std::any_of(reports.begin(), reports.end(), [frame](const auto& report) {
    return frame >= report.first && frame - report.first < report.second;
  });
}

bool Verdict::called_valid() const {
  return reports.empty() && !error;
}

Verdict judge(const Original& original, std::span<const std::uint8_t> stream, std::size_t piece,
              std::size_t memory_cap) {
  Verdict verdict;
  verdict.exact.reserve(kRoom);
  verdict.wrong.reserve(kRoom);
  verdict.reports.reserve(kRoom);
  Eye eye;
  Decoder decoder;
  decoder.use_lod(original.lod);
  const MemoryMeter meter(memory_cap);
  for (;;) {
    switch (decoder.poll()) {
      case Decoder::Event::kNeedBytes:
        if (stream.empty()) decoder.finish();
        decoder.push(stream.first(std::min(piece, stream.size())));
        stream = stream.subspan(std::min(piece, stream.size()));
        break;
      case Decoder::Event::kFrame: {
        const std::uint64_t number = decoder.frame_number();
        const bool right = number < original.frames.size() && eye.digest(decoder) == original.frames[number];
        (right ? verdict.exact : verdict.wrong).push_back(number);
        break;
      }
      case Decoder::Event::kDamage:
        verdict.reports.emplace_back(decoder.damage().first_frame, decoder.damage().frame_count);
        break;
      case Decoder::Event::kError:
        verdict.error = decoder.error().code;
        verdict.memory = meter.peak();
        return verdict;
      case Decoder::Event::kEnd:
        verdict.memory = meter.peak();
        return verdict;
      default:
        break;
    }
  }
}

void Tally::add(const Original& original, const Verdict& verdict) {
  ++cases;
  if (verdict.called_valid()) {
    ++called_valid;
  } else if (verdict.exact.empty() && verdict.wrong.empty()) {
    ++refused;
  } else if (verdict.exact.size() == original.frames.size() && verdict.wrong.empty()) {
    ++unharmed;
  } else {
    ++partly_lost;
  }
  wrong_frames += verdict.wrong.size();
  most_memory = std::max(most_memory, verdict.memory);
}

std::string Tally::text() const {
  char line[200];
  std::snprintf(line, sizeof line,
                "%zu cases: %zu without a frame, %zu with some frames, %zu with all, %zu called valid; "
                "%zu reported frames wrong; at most %zu bytes",
                cases, refused, partly_lost, unharmed, called_valid, wrong_frames, most_memory);
  return line;
}

}  // namespace tvg::corruption
