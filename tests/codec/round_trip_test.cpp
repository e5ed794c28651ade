#include "codec_toolbox.hpp"
#include "measure/curvature.hpp"
#include "measure/importance.hpp"
#include "quantization/lattice.hpp"

#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

namespace tvg::test {
namespace {

/// The box of frames [first, first + count): its lowest corner and longest side.
struct Box {
  std::array<double, 3> low;
  double extent;
};

Box box_of(const Sequence& sequence, std::size_t first, std::size_t count) {
  std::array<double, 3> low, high;
  for (std::size_t axis = 0; axis < 3; ++axis) low[axis] = high[axis] = sequence.frames[first][axis];
  for (std::size_t f = first; f < first + count; ++f) {
    for (std::size_t i = 0; i < sequence.frames[f].size(); ++i) {
      low[i % 3] = std::min(low[i % 3], double{sequence.frames[f][i]});
      high[i % 3] = std::max(high[i % 3], double{sequence.frames[f][i]});
    }
  }
  return {low, std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]})};
}

/// The flags Algorithm 1 gives the vertices of a GOP.
std::vector<std::uint8_t> expected_flags(const Sequence& sequence, const EncodeOptions& options,
                                         std::size_t first, std::size_t count) {
  if (options.fine_bits == options.coarse_bits)
    return std::vector<std::uint8_t>(sequence.mesh.vertex_count, 1);
  const std::span<const FramePositions> frames = std::span(sequence.frames).subspan(first, count);
  const Topology topology(sequence.mesh);
  const std::vector<double> costs = curvature_criterion({topology, frames, options.importance, {}, {}, {}});
  return options.importance.threshold ? flag_above(costs, *options.importance.threshold)
                                      : flag_highest_share(costs, options.importance.share);
}

/// Encodes and decodes, and compares every lattice index and flag with Algorithm 1 applied here.
void expect_lattice_back(const Sequence& sequence, const EncodeOptions& options) {
  const DecodedStream back = decode_stream(encode_sequence(sequence, options));
  ASSERT_TRUE(back.complete) << back.error.describe();
  ASSERT_TRUE(back.damage.empty());
  ASSERT_EQ(back.frames.size(), sequence.frames.size());
  ASSERT_EQ(back.meshes.size(), 1u);
  ASSERT_EQ(back.meshes[0].vertex_count, sequence.mesh.vertex_count);
  ASSERT_EQ(sorted_faces(back.meshes[0].faces), sorted_faces(sequence.mesh.faces));
  const Box box = box_of(sequence, 0, sequence.frames.size());
  std::vector<std::uint8_t> flags;
  for (std::size_t f = 0; f < sequence.frames.size(); ++f) {
    const std::size_t in_gop = f % options.gop_frames;
    if (in_gop == 0) {
      flags = expected_flags(sequence, options, f,
                             std::min<std::size_t>(options.gop_frames, sequence.frames.size() - f));
    }
    const DecodedFrame& frame = back.frames[f];
    ASSERT_EQ(frame.number, f);
    ASSERT_EQ(frame.gop.first_frame, f - in_gop);
    ASSERT_EQ(frame.flags, flags) << "frame " << f;
    Lattice lattice{box.low, box.extent / std::ldexp(1.0, options.fine_bits), options.fine_bits,
                    options.coarse_bits};
    if (box.extent == 0) lattice.step = frame.gop.step;
    ASSERT_EQ(frame.gop.step, lattice.step);
    ASSERT_EQ(frame.gop.origin, lattice.origin);
    for (std::size_t i = 0; i < frame.lattice.size(); ++i) {
      const int shift = flags[i / 3] != 0 ? 0 : lattice.shift();
      const std::int32_t index = quantize(sequence.frames[f][i], lattice.origin[i % 3], lattice) >> shift;
      ASSERT_EQ(frame.lattice[i], index) << "frame " << f << " vertex " << i / 3;
      ASSERT_EQ(frame.positions[i],
                reconstruct(index, lattice.origin[i % 3], std::ldexp(lattice.step, shift)));
    }
  }
}

TEST(Codec, LatticeOfEveryVertexIsTheEncodersOnEverySortOfMesh) {
  std::mt19937 random(1);
  std::size_t round = 0;
  for (const NamedMesh& named : all_sorts_of_meshes()) {
    if (named.mesh.vertex_count == 0) continue;
    SCOPED_TRACE(named.name);
    const Sequence sequence = random_sequence(named.mesh, 5, random);
    for (const Predictor predictor :
         {Predictor::kSpace, Predictor::kTime, Predictor::kElp, Predictor::kPyramid, Predictor::kAuto}) {
      EncodeOptions options;
      options.predictor = predictor;
      options.gop_frames = 3;
      options.coarse_bits = ++round % 2 == 0 ? 11 : 8;
      ASSERT_NO_FATAL_FAILURE(expect_lattice_back(sequence, options));
    }
  }
}

TEST(Codec, LatticeComesBackAtEveryNumberOfBits) {
  std::mt19937 random(2);
  const Sequence sequence = random_sequence(joined(grid(12, 9), random_soup(30, 40, random)), 4, random);
  for (int fine = 1; fine <= 24; ++fine) {
    for (const int coarse : {1, (fine + 1) / 2, fine}) {
      SCOPED_TRACE(std::to_string(fine) + ":" + std::to_string(coarse));
      EncodeOptions options;
      options.fine_bits = fine;
      options.coarse_bits = coarse;
      options.predictor = static_cast<Predictor>(fine % 4);
      ASSERT_NO_FATAL_FAILURE(expect_lattice_back(sequence, options));
    }
  }
}

TEST(Codec, LatticeComesBackAtEveryGopSize) {
  std::mt19937 random(3);
  const Sequence sequence = random_sequence(closed_surface(10, 6), 15, random);
  for (const std::uint32_t gop_frames : {1u, 2u, 7u, 15u, 16u, 65536u}) {
    for (const int coarse : {9, 12}) {
      SCOPED_TRACE(gop_frames);
      EncodeOptions options;
      options.fine_bits = 12;
      options.coarse_bits = coarse;
      options.gop_frames = gop_frames;
      ASSERT_NO_FATAL_FAILURE(expect_lattice_back(sequence, options));
    }
  }
}

TEST(Codec, ImportanceFollowsShareThresholdAndAlpha) {
  std::mt19937 random(4);
  const Sequence sequence = random_sequence(grid(10, 10), 6, random);
  EncodeOptions options;
  options.fine_bits = 13;
  options.gop_frames = 4;
  for (const double share : {0.0, 0.01, 0.35, 0.999, 1.0}) {
    options.importance.share = share;
    options.importance.curv.alpha = share;
    ASSERT_NO_FATAL_FAILURE(expect_lattice_back(sequence, options)) << share;
  }
  for (const double threshold : {-1.0, 0.0, 0.1, 0.2, 2.0}) {
    options.importance.threshold = threshold;
    ASSERT_NO_FATAL_FAILURE(expect_lattice_back(sequence, options)) << threshold;
  }
}

TEST(Codec, AllVerticesInOnePointComeBack) {
  Sequence sequence;
  sequence.mesh = tetrahedron();
  sequence.frames.assign(2, FramePositions(12, -3.5f));
  for (const int coarse : {6, 11}) {
    EncodeOptions options;
    options.coarse_bits = coarse;
    ASSERT_NO_FATAL_FAILURE(expect_lattice_back(sequence, options));
    const DecodedStream back = decode_stream(encode_sequence(sequence, options));
    for (const float x : back.frames[1].positions) EXPECT_NEAR(x, -3.5f, 1e-4f);
  }
}

TEST(Codec, ExtremesOfFloatComeBack) {
  constexpr float kMost = std::numeric_limits<float>::max(),
                  kLeast = std::numeric_limits<float>::denorm_min();
  const FramePositions huge = {-kMost, -kMost, -kMost, kMost, kMost, kMost, 0, 1, kMost};
  const FramePositions tiny = {0, 0, 0, kLeast, 0, 0, 0, 3 * kLeast, 0};
  for (const FramePositions& frame : {huge, tiny}) {
    Sequence sequence;
    sequence.mesh.vertex_count = 3;
    sequence.mesh.faces.push_back({0, 1, 2});
    sequence.frames.assign(2, frame);
    for (const int bits : {1, 11, 24}) {
      EncodeOptions options;
      options.fine_bits = options.coarse_bits = bits;
      ASSERT_NO_FATAL_FAILURE(expect_lattice_back(sequence, options)) << bits;
    }
  }
}

TEST(Codec, AStepIsTheEdgeOfAFineCell) {
  std::mt19937 random(5);
  const Sequence sequence = random_sequence(grid(8, 8), 3, random);
  EncodeOptions options;
  options.step = 0.01;
  options.fine_bits = 13;
  options.coarse_bits = 11;
  const DecodedStream back = decode_stream(encode_sequence(sequence, options));
  ASSERT_TRUE(back.complete);
  for (const DecodedFrame& frame : back.frames) {
    EXPECT_EQ(frame.gop.step, 0.01);
    EXPECT_EQ(frame.gop.fine_bits - frame.gop.coarse_bits, 2);
    for (std::size_t i = 0; i < frame.positions.size(); ++i) {
      const double half = (frame.flags[i / 3] != 0 ? 0.01 : 0.04) / 2;
      ASSERT_NEAR(frame.positions[i], sequence.frames[frame.number][i], half + 1e-6);
    }
  }
}

/// Every face as the paths of its corners over time, from its smallest; sorted: the surface without names.
using Path = std::vector<std::int32_t>;
std::vector<std::array<Path, 3>> nameless_surface(const DecodedStream& decoded) {
  std::vector<std::array<Path, 3>> faces;
  for (const Face& face : decoded.meshes[0].faces) {
    std::array<Path, 3> paths;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (const DecodedFrame& frame : decoded.frames) {
        const auto at = frame.lattice.begin() + 3 * static_cast<std::ptrdiff_t>(face[corner]);
        paths[corner].insert(paths[corner].end(), at, at + 3);
      }
    }
    std::rotate(paths.begin(), std::min_element(paths.begin(), paths.end()), paths.end());
    faces.push_back(paths);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

TEST(Codec, GivingUpTheVertexOrderKeepsTheSurfaceAndSavesBytes) {
  std::mt19937 random(6);
  const Mesh mesh = shuffled(joined(grid(15, 11), closed_surface(9, 5)), random);
  const Sequence sequence = random_sequence(mesh, 4, random);
  EncodeOptions kept, free;
  kept.fine_bits = kept.coarse_bits = free.fine_bits = free.coarse_bits = 20;
  free.keep_vertex_order = false;
  const Stream kept_stream = encode_sequence(sequence, kept), free_stream = encode_sequence(sequence, free);
  EXPECT_LT(free_stream.size(), kept_stream.size());
  const DecodedStream kept_back = decode_stream(kept_stream), free_back = decode_stream(free_stream);
  ASSERT_TRUE(kept_back.complete && free_back.complete);
  EXPECT_EQ(nameless_surface(free_back), nameless_surface(kept_back));
}

}  // namespace
}  // namespace tvg::test
