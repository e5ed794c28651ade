#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tvg/property_metrics.hpp>

namespace tvg {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// A square of two triangles, and the same with its faces in another order and turned.
const Mesh kSquare = {4, {{0, 1, 2}, {2, 1, 3}}};
const Mesh kTurnedSquare = {4, {{1, 3, 2}, {2, 0, 1}}};

Attribute attribute(AttributeKind kind, AttributeDomain domain, std::uint32_t components,
                    std::vector<float> values, std::vector<std::uint32_t> corners = {}) {
  Attribute made;
  made.kind = kind;
  made.domain = domain;
  made.components = components;
  made.values = std::move(values);
  made.corners = std::move(corners);
  return made;
}

Attribute generic(std::string name, std::vector<float> values) {
  Attribute made = attribute(AttributeKind::kGeneric, AttributeDomain::kVertex, 1, std::move(values));
  made.name = std::move(name);
  return made;
}

MeshProperties with(std::vector<Attribute> attributes) {
  MeshProperties properties;
  properties.attributes = std::move(attributes);
  return properties;
}

PropertyReport compare(const Mesh& a, const MeshProperties& of_a, const Mesh& b, const MeshProperties& of_b) {
  const Result<PropertyComparison> comparison = PropertyComparison::of(a, of_a, b, of_b);
  if (!comparison) {
    ADD_FAILURE() << comparison.error().message;
    return {};
  }
  return comparison->report();
}

/// Of the only attribute.
AttributeDifference difference(const Attribute& a, const Attribute& b) {
  const PropertyReport report = compare(kSquare, with({a}), kSquare, with({b}));
  EXPECT_THAT(report.attributes, SizeIs(1));
  return report.attributes.empty() ? AttributeDifference() : report.attributes[0];
}

TEST(PropertyComparison, OfBareMeshesHasNothingToReport) {
  EXPECT_TRUE(compare(kSquare, {}, kTurnedSquare, {}).empty());
}

TEST(PropertyComparison, MeasuresNumbersInTheirUnits) {
  // Off by 0, 3, 0 and -4.
  const AttributeDifference found = difference(generic("heat", {1, 2, 3, 4}), generic("heat", {1, 5, 3, 0}));
  EXPECT_EQ(found.values, 4u);
  EXPECT_DOUBLE_EQ(found.max_difference, 4);
  EXPECT_DOUBLE_EQ(found.rms_difference, 2.5);
  EXPECT_DOUBLE_EQ(found.mean_difference, 1.75);
}

TEST(PropertyComparison, MeasuresComponentsOfTextureCoordinates) {
  const AttributeDifference found = difference(
      attribute(AttributeKind::kTexcoord, AttributeDomain::kVertex, 2, {0, 0, 1, 0, 0, 1, 1, 1}),
      attribute(AttributeKind::kTexcoord, AttributeDomain::kVertex, 2, {0, 0, 1, 0, 0, 1, 0.5f, 0.5f}));
  EXPECT_DOUBLE_EQ(found.max_difference, 0.5);
  EXPECT_DOUBLE_EQ(found.rms_difference, 0.25);  // sqrt((2 * 0.25) / 8)
  EXPECT_DOUBLE_EQ(found.mean_difference, 0.125);
}

TEST(PropertyComparison, MeasuresNormalsInDegrees) {
  // 0, 90 and 180 degrees, and one that is not there on one side.
  const auto normals = [](std::vector<float> values) {
    return attribute(AttributeKind::kNormal, AttributeDomain::kVertex, 3, std::move(values));
  };
  AttributeDifference found = difference(normals({1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0}),
                                         normals({2, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0}));
  EXPECT_DOUBLE_EQ(found.max_difference, 180);
  EXPECT_DOUBLE_EQ(found.mean_difference, 67.5);
  EXPECT_DOUBLE_EQ(found.rms_difference, std::sqrt((90.0 * 90 + 180.0 * 180) / 4));
  found = difference(normals({1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}),
                     normals({1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0}));
  EXPECT_DOUBLE_EQ(found.max_difference, 180);
}

TEST(PropertyComparison, IsPreciseForSmallAngles) {
  const float tiny = 1e-6f;
  const auto normals = [](float y) {
    return attribute(AttributeKind::kNormal, AttributeDomain::kVertex, 3,
                     {1, y, 0, 1, y, 0, 1, y, 0, 1, y, 0});
  };
  EXPECT_NEAR(difference(normals(0), normals(tiny)).max_difference, 1e-6 * 180 / 3.14159265, 1e-11);
}

TEST(PropertyComparison, CountsWhatIsNotFiniteByItsBits) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(difference(generic("", {nan, inf, 0, 0}), generic("", {nan, inf, 0, 0})).max_difference, 0);
  EXPECT_EQ(difference(generic("", {nan, inf, 0, 0}), generic("", {nan, 1, 0, 0})).max_difference, inf);
}

TEST(PropertyComparison, TakesAnAlphaThatIsNotThereFor1) {
  const AttributeDifference found = difference(
      attribute(AttributeKind::kColour, AttributeDomain::kVertex, 3, std::vector<float>(12, 0.5f)),
      attribute(AttributeKind::kColour, AttributeDomain::kVertex, 4,
                {0.5f, 0.5f, 0.5f, 1, 0.5f, 0.5f, 0.5f, 1, 0.5f, 0.5f, 0.5f, 1, 0.5f, 0.5f, 0.5f, 0.75f}));
  EXPECT_DOUBLE_EQ(found.max_difference, 0.25);
}

TEST(PropertyComparison, FollowsCornersOfFacesInAnotherOrder) {
  // [face][corner]: 10, 11, 12, 22, 21, 23 in the square; the faces change places and are turned.
  const Attribute original = attribute(AttributeKind::kGeneric, AttributeDomain::kCorner, 1,
                                       {10, 11, 12, 22, 21, 23}, {0, 1, 2, 3, 4, 5});
  Attribute decoded = attribute(AttributeKind::kGeneric, AttributeDomain::kCorner, 1,
                                {21, 23, 22, 12, 10, 11}, {0, 1, 2, 3, 4, 5});
  PropertyReport report = compare(kSquare, with({original}), kTurnedSquare, with({decoded}));
  ASSERT_THAT(report.attributes, SizeIs(1));
  EXPECT_EQ(report.attributes[0].values, 6u);
  EXPECT_EQ(report.attributes[0].max_difference, 0);
  EXPECT_EQ(report.unmatched_faces, 0u);
  decoded.values[1] = 29;
  report = compare(kSquare, with({original}), kTurnedSquare, with({decoded}));
  EXPECT_EQ(report.attributes[0].max_difference, 6);
  EXPECT_DOUBLE_EQ(report.attributes[0].mean_difference, 1);
}

TEST(PropertyComparison, HoldsCornersAgainstVertices) {
  const PropertyReport report = compare(kSquare, with({generic("", {1, 2, 3, 4})}), kTurnedSquare,
                                        with({attribute(AttributeKind::kGeneric, AttributeDomain::kCorner, 1,
                                                        {1, 2, 3, 4}, {1, 3, 2, 2, 0, 1})}));
  ASSERT_THAT(report.attributes, SizeIs(1));
  EXPECT_EQ(report.attributes[0].values, 6u);
  EXPECT_EQ(report.attributes[0].max_difference, 0);
}

TEST(PropertyComparison, DoesNotTakeAFaceForItsBack) {
  const PropertyReport report = compare({3, {{0, 1, 2}}}, {}, {3, {{0, 2, 1}}}, {});
  EXPECT_EQ(report.unmatched_faces, 2u);
}

TEST(PropertyComparison, PairsByNameFirstAndThenByKind) {
  const PropertyReport report =
      compare(kSquare, with({generic("a", {1, 1, 1, 1}), generic("b", {2, 2, 2, 2})}), kSquare,
              with({generic("c", {1, 1, 1, 1}), generic("b", {2, 2, 2, 2}), generic("d", {0, 0, 0, 0})}));
  ASSERT_THAT(report.attributes, SizeIs(3));
  EXPECT_EQ(report.attributes[0].decoded_name, "c");
  EXPECT_EQ(report.attributes[0].max_difference, 0);
  EXPECT_EQ(report.attributes[1].decoded_name, "b");
  EXPECT_EQ(report.attributes[2].name, "d");
  EXPECT_EQ(report.attributes[2].presence, Presence::kDecodedOnly);
}

TEST(PropertyComparison, NamesWhatOneSideLacks) {
  const PropertyReport report = compare(kSquare, with({generic("heat", {1, 1, 1, 1})}), kSquare, {});
  ASSERT_THAT(report.attributes, SizeIs(1));
  EXPECT_EQ(report.attributes[0].presence, Presence::kOriginalOnly);
  EXPECT_EQ(report.attributes[0].name, "heat");
}

TEST(PropertyComparison, AddsUpFramesOfAnimatedAttributes) {
  Attribute moving = generic("heat", {});
  moving.animated = true;
  const MeshProperties properties = with({moving}), still = with({generic("heat", {0, 0, 0, 0})});
  Result<PropertyComparison> comparison = PropertyComparison::of(kSquare, properties, kSquare, still);
  ASSERT_TRUE(comparison);
  EXPECT_TRUE(comparison->wants_frames());
  const std::array<std::span<const float>, 1> none = {};
  const std::vector<float> first = {0, 0, 0, 4}, second = {0, 0, -8, 0};
  for (const std::vector<float>* frame : {&first, &second}) {
    const std::array<std::span<const float>, 1> values = {*frame};
    ASSERT_TRUE(comparison->add_frame(values, none).ok());
  }
  const std::array<std::span<const float>, 1> short_frame = {std::span(first).first(3)};
  EXPECT_FALSE(comparison->add_frame(short_frame, none).ok());
  const AttributeDifference found = comparison->report().attributes[0];
  EXPECT_TRUE(found.animated);
  EXPECT_EQ(found.values, 8u);
  EXPECT_EQ(found.max_difference, 8);
  EXPECT_DOUBLE_EQ(found.mean_difference, 1.5);
  EXPECT_DOUBLE_EQ(found.rms_difference, std::sqrt(80.0 / 8));
}

TEST(PropertyComparison, CountsFacesOfAnotherPartOrMaterial) {
  MeshProperties original, decoded;
  original.parts = {{"cup", "", "clay"}, {"cup", "handle", "clay"}};
  original.face_parts = {0, 1};
  decoded.parts = {{"cup", "handle", "clay"}, {"cup", "", "clay"}};
  decoded.face_parts = {0, 1};
  PropertyReport report = compare(kSquare, original, kTurnedSquare, decoded);
  EXPECT_EQ(report.parts, (CountDifference{2, 2, 0}));
  EXPECT_EQ(report.materials, (CountDifference{1, 1, 0}));
  decoded.parts[1].material = "glass";
  decoded.parts[0].group = "";
  report = compare(kSquare, original, kTurnedSquare, decoded);
  EXPECT_EQ(report.parts, (CountDifference{2, 2, 1}));
  EXPECT_EQ(report.materials, (CountDifference{1, 2, 1}));
  report = compare(kSquare, original, kTurnedSquare, {});
  EXPECT_EQ(report.parts, (CountDifference{2, 0, 2}));
  EXPECT_EQ(report.materials, (CountDifference{1, 0, 2}));
}

TEST(PropertyComparison, KnowsPolygonsByTheirOutline) {
  MeshProperties original, decoded;
  original.polygons = {{0, 4}};
  decoded.polygons = {{0, 4}};
  EXPECT_EQ(compare(kSquare, original, kTurnedSquare, decoded).polygons, (CountDifference{1, 1, 0}));
  // The same quad, cut along the other diagonal.
  const Mesh other = {4, {{0, 1, 3}, {0, 3, 2}}};
  EXPECT_EQ(compare(kSquare, original, other, decoded).polygons, (CountDifference{1, 1, 0}));
  EXPECT_EQ(compare(kSquare, original, kTurnedSquare, {}).polygons, (CountDifference{1, 0, 1}));
  const Mesh crossed = {4, {{0, 1, 2}, {1, 0, 3}}};
  EXPECT_EQ(compare(kSquare, original, crossed, decoded).polygons, (CountDifference{1, 1, 2}));
}

TEST(PropertyComparison, RefusesWhatDoesNotFit) {
  const auto refusal = [](const Mesh& mesh, const MeshProperties& properties) {
    const Result<PropertyComparison> made = PropertyComparison::of(kSquare, {}, mesh, properties);
    return made ? ErrorCode::kIo : made.error().code;
  };
  EXPECT_EQ(refusal({5, {}}, {}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(refusal({4, {{0, 1, 4}}}, {}), ErrorCode::kInvalidInput);
  EXPECT_EQ(refusal(kSquare, with({generic("", {1})})), ErrorCode::kInvalidInput);
  for (const Polygon polygon : {Polygon{0, 5}, Polygon{2, 3}, Polygon{0, 2}}) {
    MeshProperties properties;
    properties.polygons = {polygon};
    EXPECT_EQ(refusal(kSquare, properties), ErrorCode::kInvalidInput);
  }
}

TEST(PropertyComparison, PutsMeshesThatFollowEachOtherTogether) {
  PropertyReport first =
      compare(kSquare, with({generic("heat", {1, 2, 3, 4})}), kSquare, with({generic("heat", {1, 5, 3, 0})}));
  const PropertyReport second =
      compare({1, {}}, with({generic("heat", {1})}), {1, {}}, with({generic("heat", {2})}));
  first.parts = {2, 2, 1};
  const std::vector<PropertyReport> reports = {first, second};
  const PropertyReport all = together(reports);
  ASSERT_THAT(all.attributes, SizeIs(1));
  EXPECT_EQ(all.attributes[0].values, 5u);
  EXPECT_EQ(all.attributes[0].max_difference, 4);
  EXPECT_DOUBLE_EQ(all.attributes[0].mean_difference, 8.0 / 5);
  EXPECT_DOUBLE_EQ(all.attributes[0].rms_difference, std::sqrt(26.0 / 5));
  EXPECT_EQ(all.parts, (CountDifference{2, 2, 1}));
  EXPECT_THAT(together({}).attributes, IsEmpty());
}

}  // namespace
}  // namespace tvg
