#include "corruption/memory_meter.hpp"
#include "corruption/repair.hpp"
#include "tests/codec/properties_toolbox.hpp"

#include <string>

namespace tvg::corruption {
namespace {

using test::Stream;

/// A sheet of quads with all that a mesh may have.
struct Sheet {
  explicit Sheet(std::uint32_t cells) : mesh(test::grid(cells, cells)) {
    std::mt19937 random(5);
    for (std::size_t f = 0; f < mesh.faces.size(); f += 2) {
      Face &first = mesh.faces[f], &second = mesh.faces[f + 1];
      const auto in_second = [&second](std::uint32_t v) {
        return std::count(second.begin(), second.end(), v) > 0;
      };
      while (!in_second(first[0]) || !in_second(first[2]))
        std::rotate(first.begin(), first.begin() + 1, first.end());
      while (second[0] != first[0]) std::rotate(second.begin(), second.begin() + 1, second.end());
      properties.polygons.push_back({f, 4});
    }
    properties.parts = {{"sheet", "left", "red"}, {"sheet", "right", "red"}, {"rest", "", ""}};
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      properties.face_parts.push_back(static_cast<std::uint32_t>(f / 14 % 3));
    properties.attributes = {test::random_corners(
        test::attribute_of("uv", AttributeKind::kTexcoord, AttributeDomain::kCorner, 2, 12), mesh, 0.1,
        random)};
  }

  Stream encoded() const {
    std::mt19937 random(6);
    const Sequence sequence = test::random_sequence(mesh, 2, random);
    test::PropertySource source(sequence, properties);
    EncodeOptions options;
    options.data = {{"materials", std::vector<std::uint8_t>(200, 'm')}, {"note", {1, 2, 3}}};
    const Result<Stream> stream = test::try_encode(source, options);
    EXPECT_TRUE(stream);
    return stream ? *stream : Stream();
  }

  Mesh mesh;
  MeshProperties properties;
};

void expect_sane(const Mesh& mesh, const MeshProperties& properties) {
  ASSERT_EQ(properties.face_parts.size(), properties.parts.empty() ? 0 : mesh.faces.size());
  for (const std::uint32_t part : properties.face_parts) ASSERT_LT(part, properties.parts.size());
  for (const Polygon& polygon : properties.polygons) {
    ASSERT_GE(polygon.corners, 4u);
    ASSERT_LE(polygon.first_triangle + polygon.corners - 2, mesh.faces.size());
  }
  for (const Attribute& attribute : properties.attributes) {
    for (const std::uint32_t value : attribute.corners) ASSERT_LT(value, attribute.value_count());
  }
}

struct Outcome {
  std::size_t frames = 0, memory = 0;
  bool whole = false;  ///< nothing was reported
  std::optional<ErrorCode> error;
  std::uint64_t declared_memory = 0;
};

/// Decodes a stream while allocations beyond `memory_cap` fail.
Outcome decode(const Stream& stream, std::size_t memory_cap = static_cast<std::size_t>(-1)) {
  Outcome outcome;
  Decoder decoder;
  const MemoryMeter meter(memory_cap);
  decoder.push(stream);
  decoder.finish();
  outcome.whole = true;
  for (;;) {
    switch (decoder.poll()) {
      case Decoder::Event::kMesh:
        expect_sane(decoder.mesh(), decoder.properties());
        break;
      case Decoder::Event::kFrame:
        ++outcome.frames;
        break;
      case Decoder::Event::kDamage:
        outcome.whole = false;
        break;
      case Decoder::Event::kError:
        outcome.whole = false;
        outcome.error = decoder.error().code;
        [[fallthrough]];
      case Decoder::Event::kEnd:
        outcome.memory = meter.peak();
        outcome.declared_memory = decoder.head().limits.decoder_memory;
        return outcome;
      default:
        break;
    }
  }
}

std::size_t allowed_memory(const Outcome& outcome, const Stream& stream) {
  return static_cast<std::size_t>(outcome.declared_memory) + 4 * stream.size();
}

TEST(PropertyDamage, AnyByteThatIsChangedIsRefusedOrLeavesWhatIsSane) {
  const Stream good = Sheet(7).encoded();
  ASSERT_TRUE(decode(good).whole);
  std::size_t refused = 0, cases = 0;
  for (const ChunkExtent& chunk : find_chunks(good)) {
    if (chunk.type != 'M' && chunk.type != 'D') continue;
    for (std::size_t at = chunk.whole.begin + 16; at + 4 < chunk.whole.end(); ++at) {
      for (const int change : {0x01, 0x10, 0x80, 0xFF}) {
        Stream damaged = good;
        damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ change);
        ASSERT_FALSE(decode(damaged).whole) << "the chunk's checksum does not fit";
        repair_checksums(damaged);
        const Outcome outcome = decode(damaged);
        ASSERT_LE(outcome.memory, allowed_memory(outcome, damaged)) << at;
        ++cases;
        refused += outcome.whole ? 0 : 1;
      }
    }
  }
  EXPECT_GT(cases, 1000u);
  EXPECT_GT(refused, cases / 2) << "the mesh's new name alone loses its GOPs";
}

TEST(PropertyDamage, ALargeMeshTakesNoMoreMemoryThanTheHeadDeclares) {
  const Stream stream = Sheet(150).encoded();
  const Outcome outcome = decode(stream);
  ASSERT_TRUE(outcome.whole);
  EXPECT_LE(outcome.memory, allowed_memory(outcome, stream));
}

TEST(PropertyDamage, WantOfMemoryIsAnErrorWhereverItComes) {
  const Stream stream = Sheet(30).encoded();
  const std::size_t needed = decode(stream).memory;
  for (std::size_t cap = stream.size() + 20000; cap < needed; cap += needed / 150) {
    const Outcome outcome = decode(stream, cap);
    if (outcome.whole) continue;
    ASSERT_EQ(outcome.error, ErrorCode::kOutOfMemory) << cap << " of " << needed;
  }
}

}  // namespace
}  // namespace tvg::corruption
