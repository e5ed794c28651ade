#pragma once
#include "tests/connectivity/mesh_builders.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/encoder.hpp>

// Whole streams through the public interface.
namespace tvg::test {

using Stream = std::vector<std::uint8_t>;

inline Result<Stream> try_encode(FrameSource& source, const EncodeOptions& options) {
  Stream stream;
  const Result<EncodeReport> report = encode(source, options, [&stream](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  });
  if (!report) return report.error();
  EXPECT_EQ(report->bytes, stream.size());
  return stream;
}

inline Stream encode_sequence(const Sequence& sequence, const EncodeOptions& options) {
  SequenceSource source(sequence);
  Result<Stream> stream = try_encode(source, options);
  EXPECT_TRUE(stream) << (stream ? "" : stream.error().describe());
  return stream ? *stream : Stream();
}

struct DecodedFrame {
  std::uint64_t number = 0;
  std::vector<float> positions;
  std::vector<std::int32_t> lattice;
  std::vector<std::uint8_t> flags;
  GopInfo gop;
};

struct DecodedStream {
  StreamHead head;
  Metadata metadata;
  std::vector<NamedData> data;  ///< that could be unpacked
  std::vector<Mesh> meshes;
  std::vector<DecodedFrame> frames;
  std::vector<Damage> damage;
  std::vector<IndexEntry> index;
  bool complete = false;
  Error error;
};

inline DecodedFrame current_frame(const Decoder& decoder) {
  const std::size_t count = 3 * std::size_t{decoder.mesh().vertex_count};
  DecodedFrame frame{decoder.frame_number(), std::vector<float>(count), std::vector<std::int32_t>(count),
                     std::vector<std::uint8_t>(decoder.mesh().vertex_count), decoder.gop()};
  decoder.copy_positions(frame.positions.data());
  decoder.copy_lattice(frame.lattice);
  decoder.copy_flags(frame.flags);
  return frame;
}

/// Polls until bytes are needed or nothing more comes; true when the decoder wants more.
inline bool drain(Decoder& decoder, DecodedStream& result) {
  using Event = Decoder::Event;
  for (;;) {
    switch (decoder.poll()) {
      case Event::kNeedBytes:
        return true;
      case Event::kChunk:
      case Event::kGop:
        break;
      case Event::kHead:
        result.head = decoder.head();
        break;
      case Event::kMetadata:
        result.metadata = decoder.metadata();
        break;
      case Event::kData: {
        Result<NamedData> data = unpack_data(decoder.data());
        if (data) result.data.push_back(std::move(*data));
        break;
      }
      case Event::kMesh:
        result.meshes.push_back(decoder.mesh());
        break;
      case Event::kFrame:
        result.frames.push_back(current_frame(decoder));
        break;
      case Event::kDamage:
        result.damage.push_back(decoder.damage());
        break;
      case Event::kEnd:
        result.complete = true;
        result.index = decoder.index();
        return false;
      case Event::kError:
        result.error = decoder.error();
        return false;
    }
  }
}

/// Decodes a stream pushed in pieces of the sizes that `next_size` gives.
inline DecodedStream decode_pieces(const Stream& stream, const std::function<std::size_t()>& next_size,
                                   const DecoderLimits& limits = {}) {
  Decoder decoder(limits);
  DecodedStream result;
  for (std::size_t at = 0; drain(decoder, result);) {
    const std::size_t size = std::min(next_size(), stream.size() - at);
    if (at == stream.size()) decoder.finish();
    decoder.push(std::span(stream).subspan(at, size));
    at += size;
  }
  return result;
}

inline DecodedStream decode_stream(const Stream& stream, const DecoderLimits& limits = {}) {
  return decode_pieces(
      stream, [&stream] { return stream.size(); }, limits);
}

inline void expect_same_frames(const DecodedStream& a, const DecodedStream& b) {
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t f = 0; f < a.frames.size(); ++f) {
    ASSERT_EQ(a.frames[f].number, b.frames[f].number);
    ASSERT_EQ(a.frames[f].positions, b.frames[f].positions) << "frame " << f;
    ASSERT_EQ(a.frames[f].lattice, b.frames[f].lattice) << "frame " << f;
    ASSERT_EQ(a.frames[f].flags, b.frames[f].flags) << "frame " << f;
  }
}

/// Frames of a mesh whose vertices wander from random places, each at its own pace.
inline Sequence random_sequence(Mesh mesh, std::size_t frame_count, std::mt19937& random) {
  std::uniform_real_distribution<float> place(-10, 10), pace(-0.3f, 0.3f);
  Sequence sequence{std::move(mesh), {}, {}};
  FramePositions at(3 * std::size_t{sequence.mesh.vertex_count});
  for (float& x : at) x = place(random);
  for (std::size_t f = 0; f < frame_count; ++f) {
    sequence.frames.push_back(at);
    for (float& x : at) x += pace(random);
  }
  return sequence;
}

/// The faces, each from its smallest corner, in ascending order.
inline std::vector<Face> sorted_faces(std::vector<Face> faces) {
  for (Face& face : faces) {
    Face best = face;
    for (int turn = 0; turn < 2; ++turn) {
      std::rotate(face.begin(), face.begin() + 1, face.end());
      best = std::min(best, face);
    }
    face = best;
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace tvg::test
