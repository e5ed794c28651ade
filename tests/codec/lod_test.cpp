#include "codec_toolbox.hpp"
#include "corpus/corpus.hpp"
#include "tests/codec/levels_toolbox.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

// Levels and coarser meshes through the public interface (format-spec §5.5, §5.6, §7.8.1).
namespace tvg::test {
namespace {

Sequence corpus_sequence(const std::string& name) {
  return corpus::find_corpus_entry(name)->make(*corpus::named_size("small")).sequence;
}

EncodeOptions options_of(Mode mode, const std::shared_ptr<const MeshLevels>& levels) {
  EncodeOptions options;
  options.mode = mode;
  if (mode == Mode::kElp) options.predictor = Predictor::kAuto;
  options.period_frames = 8;
  options.gop_frames = 4;
  options.levels = levels;
  return options;
}

DecodedStream decode_lod(const Stream& stream, std::uint32_t lod) {
  Decoder decoder;
  decoder.use_lod(lod);
  decoder.push(stream);
  decoder.finish();
  DecodedStream decoded;
  drain(decoder, decoded);
  return decoded;
}

/// What a lod of this mesh must be.
struct ExpectedLod {
  std::vector<std::uint32_t> vertices;  ///< of the whole mesh
  std::vector<Face> faces;              ///< of the coarser one, sorted
};

ExpectedLod expected_lod(const MeshLevels& levels, std::size_t lod) {
  const CoarseMesh& coarse = levels.coarse[lod - 1];
  ExpectedLod expected;
  std::vector<std::uint32_t> number(levels.level.size());
  for (std::uint32_t v = 0; v < levels.level.size(); ++v) {
    if (levels.level[v] >= coarse.levels) continue;
    number[v] = static_cast<std::uint32_t>(expected.vertices.size());
    expected.vertices.push_back(v);
  }
  for (const Face& face : coarse.faces)
    expected.faces.push_back({number[face[0]], number[face[1]], number[face[2]]});
  expected.faces = sorted_faces(expected.faces);
  return expected;
}

/// The coarser frames are those of the whole mesh, as far as their vertices go.
void expect_part(const DecodedStream& coarse, const DecodedStream& whole, const ExpectedLod& expected) {
  ASSERT_TRUE(coarse.complete) << coarse.error.describe();
  ASSERT_TRUE(coarse.damage.empty()) << coarse.damage.front().error.describe();
  ASSERT_EQ(coarse.meshes.size(), 1u);
  EXPECT_EQ(coarse.meshes.front().vertex_count, expected.vertices.size());
  EXPECT_EQ(sorted_faces(coarse.meshes.front().faces), expected.faces);
  ASSERT_EQ(coarse.frames.size(), whole.frames.size());
  for (std::size_t f = 0; f < whole.frames.size(); ++f) {
    const DecodedFrame &a = coarse.frames[f], &b = whole.frames[f];
    std::uint32_t flagged = 0;
    for (std::size_t i = 0; i < expected.vertices.size(); ++i) {
      const std::size_t v = expected.vertices[i];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(a.positions[3 * i + axis], b.positions[3 * v + axis]) << "frame " << f;
        ASSERT_EQ(a.lattice[3 * i + axis], b.lattice[3 * v + axis]) << "frame " << f;
      }
      ASSERT_EQ(a.flags[i], b.flags[v]);
      flagged += a.flags[i];
    }
    EXPECT_EQ(a.gop.flagged, flagged);
  }
}

const char* name_of(Mode mode) {
  return mode == Mode::kElp ? "elp" : mode == Mode::kBasis ? "basis" : "lossless";
}

TEST(Lods, AreTheWholeMeshAsFarAsTheirVerticesGo) {
  for (const char* name : {"hand", "cloth", "toy", "soup"}) {
    const Sequence sequence = corpus_sequence(name);
    const auto levels = greedy_levels(sequence.mesh, 9, {2, 5, 9});
    ASSERT_GE(levels->coarse.size(), 2u);
    for (const Mode mode : {Mode::kElp, Mode::kBasis, Mode::kLossless}) {
      SCOPED_TRACE(std::string(name) + " " + name_of(mode));
      EncodeOptions options = options_of(mode, levels);
      if (mode != Mode::kLossless) options.coarse_bits = 9;
      options.importance.share = 0.3;
      const Stream stream = encode_sequence(sequence, options);
      const DecodedStream whole = decode_stream(stream);
      ASSERT_TRUE(whole.complete && whole.damage.empty()) << whole.error.describe();
      ASSERT_EQ(whole.frames.size(), sequence.frames.size());
      for (std::uint32_t lod = 1; lod <= levels->coarse.size(); ++lod)
        expect_part(decode_lod(stream, lod), whole, expected_lod(*levels, lod));
      expect_same_frames(decode_lod(stream, 100),
                         decode_lod(stream, static_cast<std::uint32_t>(levels->coarse.size())));
    }
  }
}

TEST(Levels, AloneChangeNoFrameByMoreThanTheLattice) {
  const Sequence sequence = corpus_sequence("hand");
  EncodeOptions options = options_of(Mode::kElp, nullptr);
  options.predictor = Predictor::kPyramid;
  const DecodedStream derived = decode_stream(encode_sequence(sequence, options));
  options.levels = greedy_levels(sequence.mesh, 6);
  const DecodedStream given = decode_stream(encode_sequence(sequence, options));
  expect_same_frames(given, derived);
}

TEST(Levels, ThatDoNotFitTheMeshAreRefused) {
  const Sequence sequence = corpus_sequence("cloth");
  const auto levels = greedy_levels(sequence.mesh, 4, {1, 3});
  const auto refused = [&](const auto& change) {
    auto other = std::make_shared<MeshLevels>(*levels);
    change(*other);
    SequenceSource source(sequence);
    const Result<Stream> stream = try_encode(source, options_of(Mode::kElp, other));
    return !stream && stream.error().code == ErrorCode::kInvalidArgument;
  };
  EXPECT_FALSE(refused([](MeshLevels&) {}));
  EXPECT_TRUE(refused([](MeshLevels& l) { l.level.pop_back(); }));
  EXPECT_TRUE(refused([](MeshLevels& l) { l.level[0] = 64; }));
  EXPECT_TRUE(refused([](MeshLevels& l) { l.level[0] = 63; }));
  EXPECT_TRUE(refused([](MeshLevels& l) { l.coarse[0].levels = 5; }));
  EXPECT_TRUE(refused([](MeshLevels& l) { l.coarse[1].levels = l.coarse[0].levels; }));
  EXPECT_TRUE(refused([](MeshLevels& l) { l.coarse[1].levels = 0; }));
  EXPECT_TRUE(refused([](MeshLevels& l) { l.coarse[1].faces[0] = l.coarse[0].faces[0] = {0, 1, 1u << 30}; }));
  EXPECT_TRUE(refused([](MeshLevels& l) {
    const auto finest = std::max_element(l.level.begin(), l.level.end());
    l.coarse[0].faces[0][1] = static_cast<std::uint32_t>(finest - l.level.begin());
  }));
  EXPECT_TRUE(refused([](MeshLevels& l) { l.coarse[0].faces.resize(10000); }));
  EXPECT_TRUE(refused([](MeshLevels& l) { l.coarse.resize(17); }));
}

TEST(Lods, HoldWhereTheVertexOrderIsGivenUpAndWhereACoarserMeshHasNoFace) {
  Sequence sequence = corpus_sequence("soup");
  auto levels = std::make_shared<MeshLevels>(*greedy_levels(sequence.mesh, 5, {1, 4}));
  levels->coarse[1].faces.clear();
  for (const Mode mode : {Mode::kElp, Mode::kBasis}) {
    EncodeOptions options = options_of(mode, levels);
    options.keep_vertex_order = false;
    const Stream stream = encode_sequence(sequence, options);
    const DecodedStream whole = decode_stream(stream);
    Decoder decoder;
    decoder.use_lod(2);
    decoder.push(stream);
    decoder.finish();
    DecodedStream coarse;
    drain(decoder, coarse);
    ASSERT_TRUE(coarse.complete && coarse.damage.empty());
    EXPECT_EQ(decoder.lod_count(), 2u);
    EXPECT_EQ(decoder.mesh_info().lod, 2u);
    EXPECT_TRUE(decoder.mesh().faces.empty());
    ASSERT_EQ(decoder.lod_vertices().size(), decoder.mesh().vertex_count);
    for (std::size_t i = 0; i < decoder.lod_vertices().size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(coarse.frames.back().positions[3 * i + axis],
                  whole.frames.back().positions[3 * decoder.lod_vertices()[i] + axis]);
      }
    }
  }
}

/// Reads a stream as one does who can seek, in small pieces, and counts the bytes.
DecodedStream read_seeking(const Stream& stream, std::uint32_t lod, std::size_t& bytes_read,
                           const std::vector<IndexEntry>& index = {}, std::uint64_t from = 0) {
  Decoder decoder;
  decoder.use_lod(lod);
  if (!index.empty()) decoder.set_index(index);
  DecodedStream decoded;
  std::uint64_t at = 0;
  bool sought = from == 0;
  bytes_read = 0;
  while (drain(decoder, decoded)) {
    if (!sought && at > 100) {
      sought = true;
      const Result<std::uint64_t> offset = decoder.seek(from);
      EXPECT_TRUE(offset);
      at = *offset;
      continue;
    }
    at += decoder.skip();
    if (at >= stream.size()) {
      decoder.finish();
      continue;
    }
    const std::size_t size = std::min<std::size_t>(50, stream.size() - static_cast<std::size_t>(at));
    decoder.push(std::span(stream).subspan(static_cast<std::size_t>(at), size));
    at += size;
    bytes_read += size;
  }
  return decoded;
}

/// A stream in mode basis of three periods with two coarser meshes.
struct PartedStream {
  Sequence sequence = corpus_sequence("hand");
  std::shared_ptr<const MeshLevels> levels = greedy_levels(sequence.mesh, 6, {2, 6});
  Stream stream = encode_sequence(sequence, [this] {
    EncodeOptions options = options_of(Mode::kBasis, levels);
    options.period_frames = 4;
    options.gop_frames = 2;
    return options;
  }());
};

TEST(Lods, TakeFewerBytesInModeBasis) {
  const PartedStream parted;
  std::size_t last = parted.stream.size();
  for (const std::uint32_t lod : {0u, 1u, 2u}) {
    std::size_t bytes = 0;
    const DecodedStream decoded = read_seeking(parted.stream, lod, bytes);
    EXPECT_TRUE(decoded.complete && decoded.damage.empty());
    expect_same_frames(decoded, decode_lod(parted.stream, lod));
    EXPECT_TRUE(lod == 0 ? bytes == last : bytes < last) << lod << ": " << bytes << " of " << last;
    last = bytes;
  }
}

TEST(Lods, AreSoughtWithoutTheBytesThatTheyDoNotNeed) {
  const PartedStream parted;
  const DecodedStream all = decode_stream(parted.stream);
  for (const std::uint32_t lod : {0u, 1u, 2u}) {
    const DecodedStream whole = decode_lod(parted.stream, lod);
    for (std::uint64_t from = 1; from < whole.frames.size(); ++from) {
      for (const bool by_index : {true, false}) {
        std::size_t bytes = 0;
        const DecodedStream rest =
            read_seeking(parted.stream, lod, bytes, by_index ? all.index : std::vector<IndexEntry>(), from);
        ASSERT_TRUE(rest.damage.empty()) << rest.damage.front().error.describe();
        ASSERT_EQ(rest.frames.size(), whole.frames.size() - from);
        EXPECT_EQ(rest.frames.front().number, from);
        EXPECT_EQ(rest.frames.front().positions, whole.frames[from].positions);
        EXPECT_EQ(rest.frames.back().positions, whole.frames.back().positions);
      }
    }
  }
}

TEST(Lods, AreSoughtBackAndForthWithoutAnIndex) {
  const PartedStream parted;
  const DecodedStream whole = decode_lod(parted.stream, 1);
  Decoder decoder;
  decoder.use_lod(1);
  decoder.push(parted.stream);
  DecodedStream first;
  drain(decoder, first);
  for (const std::uint64_t frame : {5u, 1u, 9u, 4u, 0u, 11u}) {
    const Result<std::uint64_t> offset = decoder.seek(frame);
    ASSERT_TRUE(offset);
    decoder.push(std::span(parted.stream).subspan(static_cast<std::size_t>(*offset)));
    DecodedStream rest;
    drain(decoder, rest);
    ASSERT_TRUE(rest.damage.empty());
    ASSERT_FALSE(rest.frames.empty());
    EXPECT_EQ(rest.frames.front().positions, whole.frames[frame].positions);
  }
}

TEST(Lods, LoseNoFrameByDamageOfFinerParts) {
  const PartedStream parted;
  const DecodedStream all = decode_stream(parted.stream);
  std::vector<std::uint64_t> parts;
  for (const IndexEntry& entry : all.index) {
    if (entry.kind == IndexEntry::Kind::kPlan) parts.push_back(entry.offset);
  }
  ASSERT_EQ(parts.size(), 9u);
  for (std::size_t part = 0; part < 3; ++part) {
    Stream damaged = parted.stream;
    damaged[static_cast<std::size_t>(parts[3 + part]) + 60] ^= 1;
    for (const std::uint32_t lod : {0u, 1u, 2u}) {
      const DecodedStream decoded = decode_lod(damaged, lod);
      EXPECT_TRUE(decoded.complete);
      const bool needed = part + lod < 3;
      EXPECT_EQ(decoded.frames.size(), all.frames.size() - (needed ? 4 : 0)) << part << ' ' << lod;
      EXPECT_FALSE(decoded.damage.empty());
    }
  }
}

TEST(Lods, TakeNoMoreMemoryThanTheHeadSays) {
  const PartedStream parted;
  const StreamLimits limits = decode_stream(parted.stream).head.limits;
  EXPECT_EQ(limits.plans, 3u);
  EXPECT_EQ(limits.decoder_memory, decoder_memory_with_lods(limits));
}

}  // namespace
}  // namespace tvg::test
