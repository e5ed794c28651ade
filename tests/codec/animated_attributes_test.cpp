#include "tests/codec/properties_toolbox.hpp"

#include <cmath>

namespace tvg::test {
namespace {

using Domain = AttributeDomain;
using Kind = AttributeKind;
/// [frame][attribute][value][component]
using Animation = std::vector<std::vector<std::vector<float>>>;

/// A sequence whose attributes have values of their own in each frame.
struct Animated {
  Sequence sequence;
  MeshProperties properties;
  Animation values;
};

/// Values that move a little, jump now and then, and stay in every third frame.
Animated animated_of(const Mesh& mesh, std::size_t frames, int bits, std::mt19937& random) {
  Animated made;
  made.sequence = random_sequence(mesh, frames, random);
  MeshProperties& properties = made.properties;
  properties.parts = {{"a", "", ""}, {"b", "", ""}};
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) properties.face_parts.push_back(f % 2 == 0 ? 0 : 1);
  const int normal_bits = bits == 0 ? 0 : std::clamp(bits, 2, 16);
  properties.attributes = {
      random_corners(attribute_of("uv", Kind::kTexcoord, Domain::kCorner, 2, bits), mesh, 0.1, random),
      random_corners(attribute_of("still", Kind::kColour, Domain::kCorner, 3), mesh, 0.1, random),
      random_values(attribute_of("n", Kind::kNormal, Domain::kVertex, 3, normal_bits), mesh.vertex_count,
                    random),
      random_corners(attribute_of("c", Kind::kColour, Domain::kCorner, 4, bits), mesh, 0.3, random),
      random_values(attribute_of("g", Kind::kGeneric, Domain::kPart, 1, bits), 2, random),
      random_values(attribute_of("x", Kind::kGeneric, Domain::kVertex, 3, bits), mesh.vertex_count, random)};
  std::normal_distribution<float> step(0, 0.01F), jump(0, 1);
  for (std::size_t f = 0; f < frames; ++f) {
    made.values.emplace_back();
    for (std::size_t a = 0; a < properties.attributes.size(); ++a) {
      Attribute& attribute = properties.attributes[a];
      std::vector<float> values = f == 0 ? attribute.values : made.values[f - 1][a];
      if (f % 3 != 2) {
        for (float& x : values) x += f % 4 == 3 ? jump(random) : step(random);
      }
      for (std::size_t i = 0; attribute.kind == Kind::kNormal && i < values.size(); i += 3) {
        const float length = std::hypot(values[i], values[i + 1], values[i + 2]);
        for (std::size_t c = 0; c < 3; ++c) values[i + c] = i % 21 == 0 ? 0 : values[i + c] / length;
      }
      made.values.back().push_back(std::move(values));
      if (attribute.name == "still") made.values[f][a].clear();
    }
  }
  for (Attribute& attribute : properties.attributes) attribute.animated = attribute.name != "still";
  return made;
}

/// The same as a source.
class AnimatedSource final : public FrameSource {
 public:
  explicit AnimatedSource(const Animated& given) : given_(given), frames_(given.sequence) {}

  const Mesh& mesh() const override { return frames_.mesh(); }
  const MeshProperties& properties() const override { return given_.properties; }
  std::span<const float> animated_values(std::size_t attribute) const override {
    return read_ == 0 ? std::span<const float>() : given_.values[read_ - 1][attribute];
  }
  std::optional<std::uint64_t> frame_count() const override { return frames_.frame_count(); }
  Result<bool> read_frame(std::span<float> positions) override {
    ++read_;
    return frames_.read_frame(positions);
  }
  bool rewind() override {
    read_ = 0;
    return frames_.rewind();
  }

 private:
  const Animated& given_;
  SequenceSource frames_;
  std::size_t read_ = 0;
};

Stream encode_animated(const Animated& given, const EncodeOptions& options) {
  AnimatedSource source(given);
  Result<Stream> stream = try_encode(source, options);
  EXPECT_TRUE(stream) << (stream ? "" : stream.error().describe());
  return stream ? *stream : Stream();
}

/// The properties with the values of a frame.
MeshProperties in_frame(const Animated& given, std::size_t frame) {
  MeshProperties properties = given.properties;
  for (std::size_t a = 0; a < properties.attributes.size(); ++a) {
    if (properties.attributes[a].animated) properties.attributes[a].values = given.values[frame][a];
  }
  return properties;
}

MeshProperties present_of(const Decoder& decoder) {
  MeshProperties properties = decoder.properties();
  for (std::size_t a = 0; a < properties.attributes.size(); ++a) {
    const std::span<const float> values = decoder.animated_values(a);
    if (properties.attributes[a].animated) {
      EXPECT_EQ(values.size(), properties.attributes[a].values.size());
      properties.attributes[a].values.assign(values.begin(), values.end());
    }
  }
  return properties;
}

/// Calls `use(frame number, decoder)` for each frame.
template <class Use>
std::vector<Damage> each_frame(const Stream& stream, const Use& use) {
  Decoder decoder;
  decoder.push(stream);
  decoder.finish();
  std::vector<Damage> damage;
  for (;;) {
    switch (decoder.poll()) {
      case Decoder::Event::kFrame:
        use(decoder.frame_number(), std::as_const(decoder));
        break;
      case Decoder::Event::kDamage:
        damage.push_back(decoder.damage());
        break;
      case Decoder::Event::kEnd:
        return damage;
      case Decoder::Event::kError:
        ADD_FAILURE() << decoder.error().describe();
        return damage;
      default:
        break;
    }
  }
}

std::vector<EncodeOptions> options_of_all_modes() {
  std::vector<EncodeOptions> all(4);
  all[1].mode = Mode::kBasis;
  all[2].mode = Mode::kLossless;
  all[3].predictor = Predictor::kAuto;
  for (EncodeOptions& options : all) options.gop_frames = 4;
  return all;
}

TEST(AnimatedAttributes, ExactOnesComeBackBitForBitInEveryModeWhateverTheMesh) {
  std::mt19937 random(1);
  for (const auto& [name, mesh] : all_sorts_of_meshes()) {
    if (mesh.vertex_count == 0) continue;
    SCOPED_TRACE(name);
    Animated given = animated_of(mesh, 7, Attribute::kExact, random);
    for (const EncodeOptions& options : options_of_all_modes()) {
      std::size_t met = 0;
      const auto damage =
          each_frame(encode_animated(given, options), [&](auto frame, const Decoder& decoder) {
            EXPECT_EQ(face_records(decoder.mesh(), present_of(decoder)),
                      face_records(mesh, in_frame(given, frame)));
            EXPECT_EQ(present_of(decoder).attributes[5].values, given.values[frame][5]);
            ++met;
          });
      EXPECT_TRUE(damage.empty()) << damage.front().error.describe();
      EXPECT_EQ(met, 7u);
    }
  }
}

TEST(AnimatedAttributes, QuantizedOnesAreOffByHalfAStepOfTheirGop) {
  std::mt19937 random(2);
  const Mesh mesh = grid(7, 6);
  for (const int bits : {1, 5, 12, 24}) {
    const Animated given = animated_of(mesh, 9, bits, random);
    for (const EncodeOptions& options : options_of_all_modes()) {
      const auto damage =
          each_frame(encode_animated(given, options), [&](auto frame, const Decoder& decoder) {
            const MeshProperties present = present_of(decoder), wanted = in_frame(given, frame);
            for (std::size_t i = 0; i < wanted.attributes[5].values.size(); ++i) {
              EXPECT_NEAR(present.attributes[5].values[i], wanted.attributes[5].values[i],
                          1000.0 / ((1 << bits) - 1) / 2 + 1e-3);
            }
            for (std::size_t v = 0; bits == 12 && v < mesh.vertex_count; ++v) {
              double apart = 0;
              for (std::size_t i = 0; i < 3; ++i)
                apart += std::abs(present.attributes[2].values[3 * v + i] -
                                  wanted.attributes[2].values[3 * v + i]);
              EXPECT_LT(apart, 0.002);
            }
          });
      EXPECT_TRUE(damage.empty()) << damage.front().error.describe();
    }
  }
}

TEST(AnimatedAttributes, AreTheSameBytesWhateverTheThreads) {
  std::mt19937 random(3);
  const Animated given = animated_of(grid(9, 9), 30, 10, random);
  for (EncodeOptions options : options_of_all_modes()) {
    const Stream one = encode_animated(given, options);
    options.threads = 3;
    EXPECT_EQ(encode_animated(given, options), one);
  }
}

TEST(AnimatedAttributes, AFrameThatRepeatsAnotherCostsAByteOfEach) {
  std::mt19937 random(4);
  Animated given = animated_of(grid(12, 12), 6, 12, random);
  for (std::size_t f = 1; f < 6; ++f) given.values[f] = given.values[0];
  each_frame(encode_animated(given, {}), [&](auto frame, const Decoder& decoder) {
    for (std::size_t a = 0; a < 6; ++a)
      EXPECT_EQ(decoder.animated_bytes(a) > 0, frame == 0 && given.properties.attributes[a].animated) << a;
  });
}

TEST(AnimatedAttributes, ASeekFindsTheValuesOfItsFrame) {
  std::mt19937 random(5);
  const Animated given = animated_of(grid(5, 5), 20, 8, random);
  EncodeOptions options;
  options.gop_frames = 6;
  const Stream stream = encode_animated(given, options);
  std::vector<MeshProperties> expected;
  each_frame(stream, [&](auto, const Decoder& decoder) { expected.push_back(present_of(decoder)); });
  ASSERT_EQ(expected.size(), 20u);
  Decoder decoder;
  decoder.push(stream);
  decoder.finish();
  while (decoder.poll() != Decoder::Event::kEnd) {
  }
  for (const std::uint64_t frame : {13u, 2u, 19u, 6u}) {
    const Result<std::uint64_t> offset = decoder.seek(frame);
    ASSERT_TRUE(offset);
    decoder.push(std::span(stream).subspan(*offset));
    decoder.finish();
    while (decoder.poll() != Decoder::Event::kFrame) {
    }
    EXPECT_EQ(decoder.frame_number(), frame);
    EXPECT_EQ(present_of(decoder), expected[frame]);
  }
}

TEST(AnimatedAttributes, ADecoderOfACoarserMeshPassesOverThem) {
  std::mt19937 random(6);
  const Animated given = animated_of(grid(5, 5), 3, 8, random);
  Decoder decoder;
  decoder.use_lod(1);
  decoder.push(encode_animated(given, {}));
  decoder.finish();
  std::size_t frames = 0;
  for (Decoder::Event event = decoder.poll(); event != Decoder::Event::kEnd; event = decoder.poll()) {
    ASSERT_NE(event, Decoder::Event::kError);
    ASSERT_NE(event, Decoder::Event::kDamage);
    frames += event == Decoder::Event::kFrame ? 1 : 0;
  }
  EXPECT_EQ(frames, 3u);
}

TEST(AnimatedAttributes, WhatIsDamagedIsNeverGivenOutAndStaysWithinItsGop) {
  std::mt19937 random(7);
  const Animated given = animated_of(grid(4, 3), 8, 6, random);
  EncodeOptions options;
  options.gop_frames = 4;
  const Stream stream = encode_animated(given, options);
  std::vector<MeshProperties> expected;
  each_frame(stream, [&](auto, const Decoder& decoder) { expected.push_back(present_of(decoder)); });
  for (std::size_t at = 200; at < stream.size(); at += 3) {
    Stream damaged = stream;
    damaged[at] ^= 0x10;
    Decoder decoder;
    decoder.push(damaged);
    decoder.finish();
    std::vector<std::uint64_t> met;
    for (bool over = false; !over;) {
      switch (decoder.poll()) {
        case Decoder::Event::kFrame:
          met.push_back(decoder.frame_number());
          EXPECT_EQ(present_of(decoder), expected[decoder.frame_number()]) << at;
          break;
        case Decoder::Event::kEnd:
        case Decoder::Event::kError:
          over = true;
          break;
        default:
          break;
      }
    }
  }
}

TEST(AnimatedAttributes, ValuesThatDoNotFitAreRefusedAndChangeNothing) {
  std::mt19937 random(8);
  const Mesh mesh = grid(3, 3);
  const Animated given = animated_of(mesh, 1, 8, random);
  Stream stream;
  Encoder encoder({}, [&](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  });
  ASSERT_TRUE(encoder.set_mesh(mesh, {}, given.properties).ok());
  const std::vector<float>& positions = given.sequence.frames[0];
  EXPECT_EQ(encoder.add_frame(positions).error().code, ErrorCode::kInvalidArgument);
  std::vector<std::vector<float>> values = given.values[0];
  const auto refused = [&] {
    const std::vector<std::span<const float>> spans(values.begin(), values.end());
    const Status status = encoder.add_frame(positions, {}, spans);
    return !status.ok() && status.error().code == ErrorCode::kInvalidInput;
  };
  values[0].resize(6);
  EXPECT_TRUE(refused()) << "fewer values than corners name";
  values = given.values[0];
  values[2].pop_back();
  EXPECT_TRUE(refused()) << "a value that is cut off";
  values = given.values[0];
  values[5][3] = INFINITY;
  EXPECT_TRUE(refused()) << "not finite";
  values = given.values[0];
  const std::vector<std::span<const float>> spans(values.begin(), values.end());
  EXPECT_TRUE(encoder.add_frame(positions, {}, spans).ok());
  EXPECT_TRUE(encoder.finish());
}

}  // namespace
}  // namespace tvg::test
