#include "codec_toolbox.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>

#include <tvg/encoder.hpp>

namespace tvg {
namespace {

using test::Stream;
using ::testing::HasSubstr;

/// A grid of size x size vertices.
Mesh grid(std::uint32_t size) {
  Mesh mesh{size * size, {}};
  for (std::uint32_t y = 0; y + 1 < size; ++y) {
    for (std::uint32_t x = 0; x + 1 < size; ++x) {
      const std::uint32_t a = y * size + x;
      mesh.faces.push_back({a, a + 1, a + size + 1});
      mesh.faces.push_back({a, a + size + 1, a + size});
    }
  }
  return mesh;
}

/// One frame after the other, each of a grid of so many vertices a side; 0 for a frame that shows nothing.
class Grids final : public FrameSource {
 public:
  explicit Grids(std::vector<std::uint32_t> sizes, bool rewinds = true)
      : sizes_(std::move(sizes)), rewinds_(rewinds) {
    begin();
  }

  const Mesh& mesh() const override { return mesh_; }
  std::optional<std::uint64_t> frame_count() const override { return sizes_.size(); }
  Result<bool> read_frame(std::span<float> positions) override {
    if (next_ == sizes_.size()) return false;
    if (sizes_[next_] != shown_) return Error{.code = ErrorCode::kInvalidInput, .message = "another mesh"};
    for (std::uint32_t v = 0; v < mesh_.vertex_count; ++v) {
      const std::uint32_t size = std::max(shown_, 1u);
      positions[3 * std::size_t{v}] = static_cast<float>(v % size);
      positions[3 * std::size_t{v} + 1] = static_cast<float>(v / size);
      positions[3 * std::size_t{v} + 2] = 0.25F * static_cast<float>(next_ + v % 3);
    }
    ++next_;
    return true;
  }
  Result<bool> begin_next_mesh() override {
    if (next_ == sizes_.size() || sizes_[next_] == shown_) return false;
    begin();
    return true;
  }
  bool mesh_may_change() const override { return true; }
  bool rewind() override {
    if (!rewinds_) return false;
    next_ = 0;
    begin();
    return true;
  }

 private:
  void begin() {
    shown_ = sizes_[next_];
    mesh_ = shown_ == 0 ? Mesh{1, {}} : grid(shown_);
  }

  std::vector<std::uint32_t> sizes_;
  bool rewinds_;
  std::size_t next_ = 0;
  std::uint32_t shown_ = 0;
  Mesh mesh_;
};

struct Encoded {
  Stream stream;
  Result<EncodeReport> report;
};

Encoded encode_grids(Grids source, const EncodeOptions& options) {
  Stream stream;
  Result<EncodeReport> report = encode(source, options, [&stream](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  });
  return {std::move(stream), std::move(report)};
}

/// Vertices of each frame, as they are decoded.
std::vector<std::size_t> decoded(const Stream& stream) {
  std::vector<std::size_t> vertices;
  Decoder decoder;
  decoder.push(stream);
  decoder.finish();
  for (;;) {
    const Decoder::Event event = decoder.poll();
    if (event == Decoder::Event::kFrame) vertices.push_back(decoder.mesh().vertex_count);
    EXPECT_NE(event, Decoder::Event::kDamage);
    EXPECT_NE(event, Decoder::Event::kError);
    if (event == Decoder::Event::kEnd || event == Decoder::Event::kError) return vertices;
  }
}

TEST(ChangingMeshes, AreFollowedInEveryModeAndSentOnce) {
  for (const Mode mode : {Mode::kElp, Mode::kBasis, Mode::kLossless}) {
    for (const Predictor predictor : {Predictor::kElp, Predictor::kPyramid}) {
      EncodeOptions options;
      options.mode = mode;
      options.predictor = predictor;
      const Encoded made = encode_grids(Grids({3, 3, 5, 5, 3, 3, 0, 5, 5, 0, 3}), options);
      ASSERT_TRUE(made.report) << made.report.error().message;
      EXPECT_EQ(made.report->meshes, 3u);
      EXPECT_EQ(made.report->frames, 11u);
      EXPECT_EQ(made.report->vertex_frames, 5 * 9 + 4 * 25 + 2u);
      EXPECT_EQ(decoded(made.stream), (std::vector<std::size_t>{9, 9, 25, 25, 9, 9, 1, 25, 25, 1, 9}));
    }
  }
}

TEST(ChangingMeshes, OfCapturedVolumesAreCodedByThemselves) {
  EncodeOptions options;
  const Grids volumes({3, 4, 5, 6, 7});
  const std::size_t in_order = encode_grids(volumes, options).stream.size();
  options.suit_captured = true;
  for (const Mode mode : {Mode::kElp, Mode::kBasis, Mode::kLossless}) {
    options.mode = mode;
    const Encoded made = encode_grids(volumes, options);
    ASSERT_TRUE(made.report);
    EXPECT_TRUE(made.report->captured);
    EXPECT_EQ(decoded(made.stream), (std::vector<std::size_t>{9, 16, 25, 36, 49}));
    if (mode != Mode::kLossless) {
      EXPECT_LT(made.stream.size(), in_order);
    }
  }
  options.mode = Mode::kElp;
  const Encoded larger = encode_grids(Grids({20, 21, 22}), options);
  Decoder decoder;
  decoder.push(larger.stream);
  decoder.finish();
  int frames = 0;
  for (Decoder::Event event = decoder.poll(); event != Decoder::Event::kEnd; event = decoder.poll()) {
    ASSERT_NE(event, Decoder::Event::kError);
    if (event != Decoder::Event::kFrame) continue;
    EXPECT_EQ(decoder.frame_predictor(), Predictor::kShape);
    ++frames;
  }
  EXPECT_EQ(frames, 3);
  EXPECT_FALSE(encode_grids(Grids({3, 4, 3, 4}), options).report->captured);
  EXPECT_FALSE(encode_grids(Grids({3, 3, 3}), options).report->captured);
}

TEST(ChangingMeshes, OfInputThatIsReadOnceNeedBoundsInAdvance) {
  EncodeOptions options;
  const Grids growing({3, 4}, false);
  const Encoded refused = encode_grids(growing, options);
  ASSERT_FALSE(refused.report);
  EXPECT_EQ(refused.report.error().code, ErrorCode::kLimitExceeded);
  EXPECT_THAT(refused.report.error().message, HasSubstr("from frame 1 on the mesh has 16 vertices"));
  EXPECT_THAT(refused.report.error().message, HasSubstr("--max-vertices"));
  options.max_vertices = 16;
  options.max_faces = 18;
  EXPECT_EQ(decoded(encode_grids(growing, options).stream), (std::vector<std::size_t>{9, 16}));
}

}  // namespace
}  // namespace tvg
