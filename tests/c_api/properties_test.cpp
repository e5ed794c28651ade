#include "c_api_toolbox.hpp"

#include <array>
#include <cstring>
#include <gmock/gmock.h>
#include <iterator>
#include <optional>
#include <utility>

#include <tvg/stream_encoder.hpp>

// Attributes, parts, polygons, data and the view through the C interface.
namespace tvg::test {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::UnorderedElementsAre;

/// Two triangles of a quad, cut along their common edge in texture coordinates.
constexpr std::uint32_t kFaces[2][3] = {{0, 1, 3}, {0, 3, 2}};
constexpr float kPositions[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
constexpr float kUv[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0.5f, 0}, {0, 1}, {1, 0.75f}};
constexpr std::uint32_t kUvCorners[6] = {0, 1, 2, 3, 5, 4};
constexpr float kHeat[4] = {-2.5f, 0, 1e-9f, 7e8f};

tvg_attribute uv() {
  tvg_attribute attribute = {};
  attribute.struct_size = sizeof attribute;
  attribute.name = "UVMap";
  attribute.kind = TVG_ATTRIBUTE_TEXCOORD;
  attribute.domain = TVG_DOMAIN_CORNER;
  attribute.components = 2;
  attribute.bits = 12;
  attribute.values = kUv;
  attribute.value_count = 6;
  attribute.corners = kUvCorners;
  attribute.corner_count = 6;
  return attribute;
}

tvg_attribute heat() {
  tvg_attribute attribute = {};
  attribute.struct_size = sizeof attribute;
  attribute.name = "heat";
  attribute.kind = TVG_ATTRIBUTE_GENERIC;
  attribute.components = 1;
  attribute.bits = TVG_EXACT_BITS;
  attribute.values = kHeat;
  attribute.value_count = 4;
  return attribute;
}

struct Encoding {
  Stream stream;
  StreamEncoder encoder{[this](const void* bytes, std::size_t size) {
    const auto* const first = static_cast<const std::uint8_t*>(bytes);
    stream.insert(stream.end(), first, first + size);
    return true;
  }};

  tvg_code set_mesh() { return encoder.set_mesh(4, kFaces[0], 2); }
  Stream finish() {
    EXPECT_EQ(encoder.add_frame(kPositions[0], 12), TVG_OK) << encoder.error_text();
    EXPECT_TRUE(encoder.finish()) << encoder.error_text();
    return stream;
  }
};

Stream rich_stream() {
  Encoding encoding;
  StreamEncoder& encoder = encoding.encoder;
  EXPECT_EQ(encoder.add_data("extras", "{\"a\": 1}", 8), TVG_OK);
  EXPECT_EQ(encoder.add_attribute(uv()), TVG_OK);
  EXPECT_EQ(encoder.add_attribute(heat()), TVG_OK);
  EXPECT_EQ(encoder.add_part("cup", "", "clay"), TVG_OK);
  EXPECT_EQ(encoder.add_part("cup", "handle", nullptr), TVG_OK);
  constexpr std::uint32_t kParts[2] = {1, 0};
  EXPECT_EQ(encoder.set_face_parts(kParts, 2), TVG_OK);
  EXPECT_EQ(encoding.set_mesh(), TVG_OK) << encoder.error_text();
  return encoding.finish();
}

/// Polls up to an event.
bool poll_to(StreamDecoder& decoder, tvg_event wanted) {
  for (;;) {
    const tvg_event event = decoder.poll();
    if (event == wanted) return true;
    if (event == TVG_EVENT_NEED_BYTES || event == TVG_EVENT_END || event == TVG_EVENT_ERROR) return false;
  }
}

StreamDecoder decoder_of(const Stream& stream) {
  StreamDecoder decoder;
  EXPECT_EQ(decoder.push(stream.data(), stream.size()), TVG_OK);
  EXPECT_EQ(decoder.finish(), TVG_OK);
  return decoder;
}

TEST(CProperties, GoInAndComeOut) {
  StreamDecoder decoder = decoder_of(rich_stream());
  EXPECT_FALSE(decoder.properties());
  ASSERT_TRUE(poll_to(decoder, TVG_EVENT_MESH));
  ASSERT_TRUE(decoder.properties());
  EXPECT_EQ(decoder.properties()->attribute_count, 2u);
  EXPECT_EQ(decoder.properties()->part_count, 2u);
  EXPECT_EQ(decoder.properties()->polygon_count, 0u);

  const std::optional<tvg_attribute_info> uv = decoder.attribute(0), heat = decoder.attribute(1);
  ASSERT_TRUE(uv && heat);
  EXPECT_FALSE(decoder.attribute(2));
  EXPECT_STREQ(uv->name, "UVMap");
  EXPECT_EQ(uv->kind, std::uint32_t{TVG_ATTRIBUTE_TEXCOORD});
  EXPECT_EQ(uv->domain, std::uint32_t{TVG_DOMAIN_CORNER});
  EXPECT_EQ(uv->components, 2u);
  EXPECT_EQ(uv->bits, 12u);
  EXPECT_EQ(uv->animated, 0u);
  EXPECT_EQ(heat->bits, std::uint32_t{TVG_EXACT_BITS});
  EXPECT_EQ(heat->value_count, 4u);

  std::array<float, 4> values{};
  ASSERT_EQ(decoder.copy_attribute(1, values.data(), 4), TVG_OK);
  EXPECT_EQ(std::memcmp(values.data(), kHeat, sizeof kHeat), 0);
  EXPECT_EQ(decoder.copy_attribute(1, values.data(), 3), TVG_ERROR_INVALID_ARGUMENT);

  const std::optional<tvg_part_info> first = decoder.part(0), second = decoder.part(1);
  ASSERT_TRUE(first && second);
  EXPECT_FALSE(decoder.part(2));
  EXPECT_STREQ(first->object, "cup");
  EXPECT_STREQ(first->material, "clay");
  EXPECT_STREQ(second->group, "handle");
  EXPECT_STREQ(second->material, "");
}

TEST(CProperties, ValuesThatChangeComeWithTheirFrames) {
  Encoding encoding;
  StreamEncoder& encoder = encoding.encoder;
  tvg_attribute moving = heat(), seams = uv();
  moving.animated = seams.animated = 1;
  moving.values = seams.values = nullptr;
  seams.bits = TVG_EXACT_BITS;
  EXPECT_EQ(encoder.set_values(0, kHeat, 4, 1), TVG_ERROR_WRONG_STATE);
  ASSERT_EQ(encoder.add_attribute(moving), TVG_OK) << encoder.error_text();
  ASSERT_EQ(encoder.add_attribute(seams), TVG_OK) << encoder.error_text();
  ASSERT_EQ(encoder.add_attribute(heat()), TVG_OK);
  ASSERT_EQ(encoding.set_mesh(), TVG_OK) << encoder.error_text();
  EXPECT_EQ(encoder.add_frame(kPositions[0], 12), TVG_ERROR_INVALID_INPUT) << "there are no values yet";
  EXPECT_EQ(encoder.set_values(2, kHeat, 4, 1), TVG_ERROR_INVALID_ARGUMENT) << "it is not animated";
  EXPECT_EQ(encoder.set_values(3, kHeat, 4, 1), TVG_ERROR_INVALID_ARGUMENT) << "there is none";
  ASSERT_EQ(encoder.set_values(0, kHeat, 4, 1), TVG_OK);
  ASSERT_EQ(encoder.set_values(1, kUv[0], 12, 2), TVG_OK);
  ASSERT_EQ(encoder.add_frame(kPositions[0], 12), TVG_OK) << encoder.error_text();
  constexpr float kCold[4] = {1, 2, 3, 4};
  ASSERT_EQ(encoder.set_values(0, kCold, 4, 1), TVG_OK);
  const Stream stream = encoding.finish();

  StreamDecoder decoder = decoder_of(stream);
  ASSERT_TRUE(poll_to(decoder, TVG_EVENT_MESH));
  ASSERT_TRUE(decoder.attribute(0) && decoder.attribute(1));
  EXPECT_EQ(decoder.attribute(0)->animated, 1u);
  EXPECT_EQ(decoder.attribute(0)->value_count, 4u);
  EXPECT_EQ(decoder.attribute(1)->value_count, 6u);
  std::array<float, 12> values{};
  EXPECT_EQ(decoder.copy_attribute(0, values.data(), 4), TVG_ERROR_WRONG_STATE) << "there is no frame";
  for (const float* const expected : {kHeat, kCold}) {
    ASSERT_TRUE(poll_to(decoder, TVG_EVENT_FRAME));
    ASSERT_EQ(decoder.copy_attribute(0, values.data(), 4), TVG_OK);
    EXPECT_EQ(std::memcmp(values.data(), expected, 16), 0);
    ASSERT_TRUE(decoder.view());
    ASSERT_EQ(decoder.copy_view_attribute(0, values.data(), decoder.view()->vertex_count), TVG_OK);
    EXPECT_EQ(std::memcmp(values.data(), expected, 16), 0);
    ASSERT_EQ(decoder.copy_attribute(1, values.data(), 12), TVG_OK);
    std::array<std::uint32_t, 6> corners{};
    ASSERT_EQ(decoder.copy_corners(1, corners.data(), 6), TVG_OK);
    const std::array<float, 12> given = values;
    EXPECT_THAT(given, ::testing::UnorderedElementsAreArray(kUv[0], 12));
  }
}

TEST(CProperties, CornersAndPartsFollowTheFaces) {
  StreamDecoder decoder = decoder_of(rich_stream());
  ASSERT_TRUE(poll_to(decoder, TVG_EVENT_MESH));
  const tvg_mesh_info mesh = *decoder.mesh();
  std::vector<float> values(2 * decoder.attribute(0)->value_count);
  std::array<std::uint32_t, 6> corners{}, of_vertices{};
  std::array<std::uint32_t, 2> parts{};
  ASSERT_EQ(decoder.copy_attribute(0, values.data(), values.size()), TVG_OK);
  ASSERT_EQ(decoder.copy_corners(0, corners.data(), 6), TVG_OK);
  ASSERT_EQ(decoder.copy_corners(1, of_vertices.data(), 6), TVG_OK);
  ASSERT_EQ(decoder.copy_face_parts(parts.data(), 2), TVG_OK);
  EXPECT_EQ(decoder.copy_corners(0, corners.data(), 5), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(decoder.copy_face_parts(parts.data(), 1), TVG_ERROR_INVALID_ARGUMENT);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(of_vertices[i], mesh.faces[i]);
    // The face that has vertex 1 is the first; vertices 0 and 3 have other values in the other.
    const std::uint32_t* const face = mesh.faces + i / 3 * 3;
    const bool is_first = face[0] == 1 || face[1] == 1 || face[2] == 1;
    EXPECT_EQ(parts[i / 3], is_first ? 1u : 0u);
    std::size_t original = 0;
    while (kFaces[is_first ? 0 : 1][original] != mesh.faces[i]) ++original;
    const float* const expected = kUv[kUvCorners[(is_first ? 0 : 3) + original]];
    EXPECT_NEAR(values[2 * corners[i]], expected[0], 1.0 / 8000);
    EXPECT_NEAR(values[2 * corners[i] + 1], expected[1], 1.0 / 8000);
  }
}

TEST(CProperties, TheViewHasOneIndexForAll) {
  StreamDecoder decoder = decoder_of(rich_stream());
  ASSERT_TRUE(poll_to(decoder, TVG_EVENT_MESH));
  EXPECT_FALSE(decoder.view_range(0)) << "before the view is made";
  const std::optional<tvg_view_info> view = decoder.view();
  ASSERT_TRUE(view);
  EXPECT_EQ(view->vertex_count, 6u);
  EXPECT_EQ(view->index_count, 6u);
  ASSERT_EQ(view->range_count, 2u);
  EXPECT_EQ(decoder.view_range(0)->first_index, 0u);
  EXPECT_EQ(decoder.view_range(1)->first_index, 3u);
  EXPECT_EQ(decoder.view_range(1)->index_count, 3u);
  EXPECT_FALSE(decoder.view_range(2));
  EXPECT_EQ(view->source_vertices[4], 0u);
  EXPECT_EQ(view->source_vertices[5], 3u);
  std::array<std::uint32_t, 6> chosen{};
  ASSERT_EQ(tvg_decoder_copy_view_values(decoder.get(), 1, chosen.data(), 6), TVG_OK);
  EXPECT_THAT(chosen, ElementsAre(0, 1, 2, 3, 0, 3));
  // The first part is the face without vertex 1.
  const std::vector<std::uint32_t> corners = {view->source_vertices[view->indices[0]],
                                              view->source_vertices[view->indices[1]],
                                              view->source_vertices[view->indices[2]]};
  EXPECT_THAT(corners, UnorderedElementsAre(0, 3, 2));

  std::array<float, 18> positions{}, normals{};
  EXPECT_EQ(decoder.copy_view_positions(positions.data(), 18), TVG_ERROR_WRONG_STATE);
  ASSERT_TRUE(poll_to(decoder, TVG_EVENT_FRAME));
  ASSERT_EQ(decoder.copy_view_positions(positions.data(), 18), TVG_OK);
  ASSERT_EQ(decoder.compute_view_normals(normals.data(), 18), TVG_OK);
  EXPECT_EQ(decoder.copy_view_positions(positions.data(), 17), TVG_ERROR_INVALID_ARGUMENT);
  for (std::size_t v = 0; v < 6; ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(positions[3 * v + axis], kPositions[view->source_vertices[v]][axis], 1.0 / 2048);
    EXPECT_EQ(normals[3 * v + 2], 1);
  }
  std::array<float, 6> warmth{};
  ASSERT_EQ(decoder.copy_view_attribute(1, warmth.data(), 6), TVG_OK);
  EXPECT_THAT(warmth, ElementsAre(kHeat[0], kHeat[1], kHeat[2], kHeat[3], kHeat[0], kHeat[3]));
  EXPECT_EQ(decoder.copy_view_attribute(2, warmth.data(), 6), TVG_ERROR_INVALID_ARGUMENT);
}

TEST(CProperties, ABareMeshHasNoneAndAViewAllTheSame) {
  Encoding encoding;
  ASSERT_EQ(encoding.set_mesh(), TVG_OK);
  StreamDecoder decoder = decoder_of(encoding.finish());
  ASSERT_TRUE(poll_to(decoder, TVG_EVENT_MESH));
  EXPECT_EQ(decoder.properties()->attribute_count, 0u);
  std::array<std::uint32_t, 2> parts = {7, 7};
  EXPECT_EQ(decoder.copy_face_parts(parts.data(), 2), TVG_OK);
  EXPECT_THAT(parts, ElementsAre(0, 0));
  const std::optional<tvg_view_info> view = decoder.view();
  ASSERT_TRUE(view);
  EXPECT_EQ(view->vertex_count, 4u);
  EXPECT_EQ(view->range_count, 1u);
  EXPECT_EQ(decoder.view_range(0)->index_count, 6u);
  EXPECT_EQ(std::memcmp(view->indices, decoder.mesh()->faces, 6 * sizeof(std::uint32_t)), 0);
}

TEST(CProperties, PolygonsAreRemembered) {
  Encoding encoding;
  constexpr tvg_polygon kQuad = {0, 4};
  ASSERT_EQ(encoding.encoder.set_polygons(&kQuad, 1), TVG_OK);
  ASSERT_EQ(encoding.set_mesh(), TVG_OK) << encoding.encoder.error_text();
  StreamDecoder decoder = decoder_of(encoding.finish());
  ASSERT_TRUE(poll_to(decoder, TVG_EVENT_MESH));
  ASSERT_EQ(decoder.properties()->polygon_count, 1u);
  tvg_polygon polygon = {};
  EXPECT_EQ(decoder.copy_polygons(&polygon, 0), TVG_ERROR_INVALID_ARGUMENT);
  ASSERT_EQ(decoder.copy_polygons(&polygon, 1), TVG_OK);
  EXPECT_EQ(polygon.first_face, 0u);
  EXPECT_EQ(polygon.corner_count, 4u);
}

TEST(CProperties, DataAreThereWithTheirEvent) {
  StreamDecoder decoder = decoder_of(rich_stream());
  EXPECT_FALSE(decoder.data());
  ASSERT_TRUE(poll_to(decoder, TVG_EVENT_DATA));
  const std::optional<tvg_data_info> data = decoder.data();
  ASSERT_TRUE(data);
  EXPECT_STREQ(data->name, "extras");
  ASSERT_EQ(data->size, 8u);
  std::array<char, 8> bytes{};
  EXPECT_EQ(decoder.copy_data(bytes.data(), 7), TVG_ERROR_INVALID_ARGUMENT);
  ASSERT_EQ(decoder.copy_data(bytes.data(), 8), TVG_OK) << decoder.error_text();
  EXPECT_THAT(bytes, ElementsAreArray("{\"a\": 1}", 8));
  decoder.poll();
  EXPECT_FALSE(decoder.data());
  EXPECT_EQ(decoder.copy_data(bytes.data(), 8), TVG_ERROR_WRONG_STATE);
}

TEST(CProperties, WhatDoesNotFitIsRefusedAndKeptUntilItIsCleared) {
  Encoding encoding;
  StreamEncoder& encoder = encoding.encoder;
  tvg_attribute wrong = heat();
  wrong.value_count = 3;
  EXPECT_EQ(encoder.add_attribute(wrong), TVG_OK);
  EXPECT_EQ(encoding.set_mesh(), TVG_ERROR_INVALID_INPUT);
  EXPECT_EQ(encoding.set_mesh(), TVG_ERROR_INVALID_INPUT);
  EXPECT_EQ(encoder.clear_properties(), TVG_OK);
  constexpr void (*kMistakes[])(tvg_attribute&) = {
      [](tvg_attribute& bad) { bad.struct_size = 0; }, [](tvg_attribute& bad) { bad.kind = 4; },
      [](tvg_attribute& bad) { bad.domain = 3; },      [](tvg_attribute& bad) { bad.components = 5; },
      [](tvg_attribute& bad) { bad.stride = 3; },      [](tvg_attribute& bad) { bad.values = nullptr; },
      [](tvg_attribute& bad) { bad.corner_count = 6; }};
  for (std::size_t i = 0; i < std::size(kMistakes); ++i) {
    tvg_attribute bad = heat();
    kMistakes[i](bad);
    EXPECT_EQ(encoder.add_attribute(bad), TVG_ERROR_INVALID_ARGUMENT) << i;
  }
  EXPECT_EQ(encoder.add_attribute(heat()), TVG_OK);
  EXPECT_EQ(encoding.set_mesh(), TVG_OK) << encoder.error_text();
  EXPECT_EQ(encoder.add_data("late", "", 0), TVG_ERROR_WRONG_STATE);
  StreamDecoder decoder = decoder_of(encoding.finish());
  ASSERT_TRUE(poll_to(decoder, TVG_EVENT_MESH));
  EXPECT_EQ(decoder.properties()->attribute_count, 1u);
}

TEST(CProperties, ValuesComeFromRowsOfAnyStride) {
  struct Row {
    std::uint32_t other;
    float heat;
  };
  std::array<Row, 4> rows{};
  for (std::size_t i = 0; i < 4; ++i) rows[i] = {0xFFFFFFFF, kHeat[i]};
  Encoding encoding;
  tvg_attribute strided = heat();
  strided.values = &rows[0].heat;
  strided.stride = sizeof(Row);
  ASSERT_EQ(encoding.encoder.add_attribute(strided), TVG_OK);
  ASSERT_EQ(encoding.set_mesh(), TVG_OK) << encoding.encoder.error_text();
  StreamDecoder decoder = decoder_of(encoding.finish());
  ASSERT_TRUE(poll_to(decoder, TVG_EVENT_MESH));
  for (Row& row : rows) row = {7, 0};
  ASSERT_EQ(tvg_decoder_copy_attribute(decoder.get(), 0, &rows[0].heat, sizeof rows - 4, sizeof(Row)),
            TVG_OK);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(rows[i].heat, kHeat[i]);
    EXPECT_EQ(rows[i].other, 7u);
  }
}

TEST(CProperties, AskingWithoutADecoderIsAnError) {
  EXPECT_EQ(tvg_decoder_get_properties(nullptr, nullptr), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_get_view(nullptr, nullptr), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_get_data(nullptr, nullptr), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_encoder_add_attribute(nullptr, nullptr), TVG_ERROR_INVALID_ARGUMENT);
  const StreamDecoder decoder;
  tvg_properties_info info = {};
  info.struct_size = sizeof info;
  EXPECT_EQ(tvg_decoder_get_properties(decoder.get(), &info), TVG_ERROR_WRONG_STATE);
}

}  // namespace
}  // namespace tvg::test
