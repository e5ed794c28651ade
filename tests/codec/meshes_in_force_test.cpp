#include "codec_toolbox.hpp"

#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <vector>

#include <tvg/encoder.hpp>
#include <tvg/survey.hpp>

// Several meshes in force: GOPs name theirs, whichever chunks lie between.
namespace tvg::test {
namespace {

/// A fan of so many triangles; each count is another mesh.
Mesh fan(std::uint32_t triangles) {
  Mesh mesh{triangles + 2, {}};
  for (std::uint32_t i = 0; i < triangles; ++i) mesh.faces.push_back({0, i + 1, i + 2});
  return mesh;
}

struct Show {
  Stream stream;
  std::vector<std::uint32_t> vertices;  ///< [frame], which tells the meshes apart
};

/// Frames of meshes that come and go at random, three of each in GOPs of two, coded with so many in force.
Show encode_show(std::uint32_t max_meshes, std::size_t stretches = 30) {
  std::mt19937 random(max_meshes);
  Show show;
  EncodeOptions options;
  options.gop_frames = 2;
  options.max_meshes = max_meshes;
  options.max_vertices = 100;
  options.max_faces = 100;
  Encoder encoder(options, [&show](std::span<const std::uint8_t> bytes) {
    show.stream.insert(show.stream.end(), bytes.begin(), bytes.end());
    return Status();
  });
  std::uniform_real_distribution<float> anywhere(-1, 1);
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < stretches; ++i) {
    std::uint32_t triangles = 1 + static_cast<std::uint32_t>(random() % 4);
    if (triangles == last) triangles = 5;
    last = triangles;
    EXPECT_TRUE(encoder.set_mesh(fan(triangles)).ok());
    for (int f = 0; f < 3; ++f) {
      FramePositions frame(3 * std::size_t{triangles + 2});
      for (float& x : frame) x = anywhere(random);
      EXPECT_TRUE(encoder.add_frame(frame).ok());
      show.vertices.push_back(triangles + 2);
    }
  }
  EXPECT_TRUE(encoder.finish());
  return show;
}

std::size_t mesh_chunks(const Stream& stream) {
  const Result<StreamSurvey> result = survey([&](std::uint64_t offset, std::span<std::uint8_t> bytes) {
    const std::size_t at = std::min(static_cast<std::size_t>(offset), stream.size());
    const std::size_t count = std::min(bytes.size(), stream.size() - at);
    std::copy_n(stream.begin() + static_cast<std::ptrdiff_t>(at), count, bytes.begin());
    return Result<std::size_t>(count);
  });
  EXPECT_TRUE(result);
  EXPECT_TRUE(result->findings.empty());
  return result->meshes.size();
}

std::vector<std::uint32_t> vertices_of(const DecodedStream& stream) {
  std::vector<std::uint32_t> vertices;
  for (const DecodedFrame& frame : stream.frames)
    vertices.push_back(static_cast<std::uint32_t>(frame.positions.size() / 3));
  return vertices;
}

TEST(MeshesInForce, EveryFrameComesWithItsMeshAndFewerMeshesAreSentTheMoreAreKept) {
  std::size_t before = 1000;
  for (const std::uint32_t kept : {1u, 2u, 3u, 5u}) {
    const Show show = encode_show(kept);
    const DecodedStream back = decode_stream(show.stream);
    ASSERT_TRUE(back.complete) << back.error.describe();
    EXPECT_TRUE(back.damage.empty());
    EXPECT_EQ(back.head.limits.meshes, kept);
    EXPECT_EQ(vertices_of(back), show.vertices);
    const std::size_t sent = mesh_chunks(show.stream);
    EXPECT_LT(sent, before) << kept;
    before = sent;
  }
  EXPECT_EQ(before, 5u) << "each once, where all are kept";
}

TEST(MeshesInForce, PiecesOfAnySizeGiveTheSame) {
  const Show show = encode_show(3);
  const DecodedStream whole = decode_stream(show.stream);
  for (const std::size_t piece : {1u, 7u, 100u})
    expect_same_frames(whole, decode_pieces(show.stream, [piece] { return piece; }));
}

/// Seeks at random and reads on for a while, as a player does.
class Player {
 public:
  Player(const Stream& stream, bool hops) : stream_(stream), hops_(hops) {
    while (next() != Decoder::Event::kHead) {
    }
  }

  Decoder::Event next() {
    for (;;) {
      const Decoder::Event event = decoder.poll();
      if (event != Decoder::Event::kNeedBytes) return event;
      if (hops_) at_ += static_cast<std::size_t>(decoder.skip());
      const std::size_t count = std::min<std::size_t>(50, stream_.size() - std::min(at_, stream_.size()));
      if (count == 0) decoder.finish();
      if (count > 0) decoder.push(std::span(stream_).subspan(at_, count));
      at_ += count;
    }
  }

  void seek(std::uint64_t frame) {
    const Result<std::uint64_t> offset = decoder.seek(frame);
    ASSERT_TRUE(offset);
    at_ = static_cast<std::size_t>(*offset);
  }

  Decoder decoder;

 private:
  const Stream& stream_;
  bool hops_;
  std::size_t at_ = 0;
};

TEST(MeshesInForce, SeeksFindTheMeshesOfTheFramesAskedForAndOfThoseBehind) {
  for (const std::uint32_t kept : {1u, 2u, 3u, 5u}) {
    const Show show = encode_show(kept);
    const DecodedStream whole = decode_stream(show.stream);
    ASSERT_EQ(whole.frames.size(), 90u);
    for (const bool with_index : {true, false}) {
      for (const bool hops : {true, false}) {
        SCOPED_TRACE(testing::Message() << kept << " kept, index " << with_index << ", hops " << hops);
        Player player(show.stream, hops);
        if (with_index) player.decoder.set_index(whole.index);
        std::mt19937 random(3);
        for (int i = 0; i < 40; ++i) {
          std::uint64_t frame = random() % 90;
          ASSERT_NO_FATAL_FAILURE(player.seek(frame));
          for (const std::uint64_t end = std::min<std::uint64_t>(90, frame + random() % 30); frame < end;) {
            const Decoder::Event event = player.next();
            ASSERT_NE(event, Decoder::Event::kError);
            ASSERT_NE(event, Decoder::Event::kDamage) << player.decoder.damage().error.describe();
            ASSERT_NE(event, Decoder::Event::kEnd);
            if (event != Decoder::Event::kFrame) continue;
            ASSERT_EQ(player.decoder.frame_number(), frame);
            ASSERT_EQ(player.decoder.mesh().vertex_count, show.vertices[static_cast<std::size_t>(frame)]);
            ASSERT_EQ(current_frame(player.decoder).positions,
                      whole.frames[static_cast<std::size_t>(frame)].positions);
            ++frame;
          }
        }
      }
    }
  }
}

TEST(MeshesInForce, AMeshThatIsDamagedCostsTheFramesThatNameItAndNoOther) {
  const Show show = encode_show(5);
  const DecodedStream whole = decode_stream(show.stream);
  ASSERT_EQ(whole.index[0].kind, IndexEntry::Kind::kMesh);
  Stream stream = show.stream;
  stream[static_cast<std::size_t>(whole.index[0].offset) + 20] ^= 1;
  const DecodedStream back = decode_stream(stream);
  ASSERT_TRUE(back.complete);
  const auto of_first_mesh =
      static_cast<std::uint64_t>(std::count(show.vertices.begin(), show.vertices.end(), show.vertices[0]));
  const std::uint64_t lost =
      std::accumulate(back.damage.begin(), back.damage.end(), std::uint64_t{0},
                      [](std::uint64_t sum, const Damage& damage) { return sum + damage.frame_count; });
  EXPECT_EQ(lost, of_first_mesh);
  ASSERT_EQ(back.frames.size() + lost, 90u);
  for (const DecodedFrame& frame : back.frames)
    EXPECT_EQ(frame.positions, whole.frames[static_cast<std::size_t>(frame.number)].positions);
}

TEST(MeshesInForce, NoneOrTooManyAreRefused) {
  for (const std::uint32_t meshes : {0u, 65537u}) {
    EncodeOptions options;
    options.max_meshes = meshes;
    Encoder encoder(options, [](std::span<const std::uint8_t>) { return Status(); });
    const Status status = encoder.set_mesh(fan(1));
    ASSERT_FALSE(status.ok()) << meshes;
    EXPECT_EQ(status.error().code, ErrorCode::kInvalidArgument);
  }
}

}  // namespace
}  // namespace tvg::test
