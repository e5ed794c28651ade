#include "tests/importers/scene_fixture.hpp"

#include <gmock/gmock.h>
#include <meshoptimizer.h>

// How numbers are kept in a glTF file.
namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class GltfValues : public Scenes {
 protected:
  /// The one frame of a triangle with these positions.
  FramePositions frame(GltfBuilder& gltf, int positions, int indices = -1) {
    nlohmann::json primitive = {{"attributes", {{"POSITION", positions}}}};
    if (indices >= 0) primitive["indices"] = indices;
    set_mesh(gltf, primitive);
    const std::vector<FramePositions> read = frames(gltf, "30");
    return read.empty() ? FramePositions(9) : read[0];
  }
};

TEST_F(GltfValues, PositionsMayBeIntegers) {
  GltfBuilder bytes;
  const FramePositions whole = frame(bytes, bytes.add<std::int8_t>("VEC3", {0, 0, 0, 100, 0, 0, 0, -128, 7}));
  expect_vertex(whole, 1, 100, 0, 0);
  expect_vertex(whole, 2, 0, -128, 7);
  GltfBuilder unsigned_bytes;
  expect_vertex(
      frame(unsigned_bytes, unsigned_bytes.add<std::uint8_t>("VEC3", {0, 0, 0, 200, 0, 0, 0, 255, 0})), 2, 0,
      255, 0);
  GltfBuilder shorts;
  expect_vertex(frame(shorts, shorts.add<std::int16_t>("VEC3", {0, 0, 0, -300, 0, 0, 0, 9, 0})), 1, -300, 0,
                0);
}

TEST_F(GltfValues, NormalizedIntegersAreFractions) {
  GltfBuilder shorts;
  const FramePositions signed_ones =
      frame(shorts, shorts.add_normalized<std::int16_t>("VEC3", {0, 0, 0, 32767, 0, 0, 0, -32768, 16384}));
  expect_vertex(signed_ones, 1, 1, 0, 0);
  expect_vertex(signed_ones, 2, 0, -1, 16384.0F / 32767);
  GltfBuilder bytes;
  expect_vertex(frame(bytes, bytes.add_normalized<std::int8_t>("VEC3", {0, 0, 0, 127, 0, 0, 0, -128, 0})), 2,
                0, -1, 0);
  GltfBuilder unsigned_shorts;
  expect_vertex(frame(unsigned_shorts, unsigned_shorts.add_normalized<std::uint16_t>(
                                           "VEC3", {0, 0, 0, 65535, 0, 0, 0, 13107, 0})),
                2, 0, 0.2F, 0);
}

TEST_F(GltfValues, WeightsAndJointsMayBeBytesOrShorts) {
  const auto check = [this](auto weight, auto joint, std::vector<int> of_middle) {
    using Weight = decltype(weight);
    using Joint = decltype(joint);
    GltfBuilder gltf = skinned_strip();
    const Weight most = std::numeric_limits<Weight>::max();
    const auto a = static_cast<Weight>(of_middle[0]), b = static_cast<Weight>(of_middle[1]);
    nlohmann::json& attributes = gltf.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["WEIGHTS_0"] = gltf.add_normalized<Weight>(
        "VEC4", {most, 0, 0, 0, most, 0, 0, 0, a, b, 0, 0, a, b, 0, 0, 0, most, 0, 0, 0, most, 0, 0});
    std::vector<Joint> joints;
    for (int vertex = 0; vertex < 6; ++vertex) joints.insert(joints.end(), {0, 1, 0, 0});
    attributes["JOINTS_0"] = gltf.add<Joint>("VEC4", joints);
    const FramePositions last = frames(gltf, "2").at(2);
    const auto share = static_cast<float>(double(of_middle[1]) / (of_middle[0] + of_middle[1]));
    // The upper bone turns (11, 1) about (10, 1) to (10, 2).
    expect_vertex(last, 3, 11 - share, 1 + share, 0);
    expect_vertex(last, 5, 9, 2, 0);
  };
  check(std::uint8_t{}, std::uint8_t{}, {127, 128});
  check(std::uint8_t{}, std::uint16_t{}, {64, 191});
  check(std::uint16_t{}, std::uint8_t{}, {13107, 52428});
  check(std::uint16_t{}, std::uint16_t{}, {32767, 32768});
}

TEST_F(GltfValues, MoreThanFourJointsMoveAVertex) {
  GltfBuilder gltf = skinned_strip();
  nlohmann::json& attributes = gltf.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_1"] = gltf.add<std::uint8_t>("VEC4", std::vector<std::uint8_t>(24, 1));
  std::vector<float> weights(24, 0);
  weights[12] = 2;  // of vertex 3: 0.5 of the lower bone, 0.5 + 2 of the upper one
  attributes["WEIGHTS_1"] = gltf.add<float>("VEC4", weights);
  expect_vertex(frames(gltf, "2").at(2), 3, 11 - 2.5F / 3, 1 + 2.5F / 3, 0);
}

TEST_F(GltfValues, RotationsAndWeightsOfClipsMayBeIntegers) {
  GltfBuilder gltf = one_triangle();
  gltf.animate(0, 0, "rotation", {0, 1},
               gltf.add_normalized<std::int16_t>("VEC4", {0, 0, 0, 32767, 0, 0, 23170, 23170}), "LINEAR");
  const FramePositions last = frames(gltf, "1").at(1);
  expect_vertex(last, 1, 0, 1, 0);
  GltfBuilder bytes = one_triangle();
  bytes.animate(0, 0, "rotation", {0, 1},
                bytes.add_normalized<std::int8_t>("VEC4", {0, 0, 0, 127, 0, 0, 127, 0}), "LINEAR");
  expect_vertex(frames(bytes, "1").at(1), 1, -1, 0, 0);
  GltfBuilder morph = morphing_triangle();
  morph.animate(0, 0, "weights", {0, 1}, morph.add_normalized<std::uint8_t>("SCALAR", {0, 255, 51, 0}),
                "LINEAR");
  const std::vector<FramePositions> read = frames(morph, "1");
  expect_vertex(read.at(0), 1, 3, 0, 1);
  expect_vertex(read.at(1), 2, 0, 1, 1 + 8 * 0.2F);
}

TEST_F(GltfValues, MorphTargetsMayBeIntegers) {
  GltfBuilder gltf = morphing_triangle();
  gltf.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] =
      gltf.add_normalized<std::int8_t>("VEC3", {0, 0, 0, 0, 0, 0, 0, 0, 127});
  gltf.json["meshes"][0]["weights"] = {1, 0};
  expect_vertex(frames(gltf, "1").at(0), 2, 0, 1, 2);
}

TEST_F(GltfValues, IndicesMayBeBytesAndWords) {
  GltfBuilder gltf;
  const int positions = gltf.add<float>("VEC3", {9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0});
  for (const int indices :
       {gltf.add<std::uint8_t>("SCALAR", {1, 2, 3}), gltf.add<std::uint32_t>("SCALAR", {1, 2, 3})}) {
    set_mesh(gltf, {{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    EXPECT_EQ(open(gltf).source->mesh().faces, (std::vector<Face>{{1, 2, 3}}));
  }
  set_mesh(gltf, {{"attributes", {{"POSITION", positions}}},
                  {"indices", gltf.add<std::uint8_t>("SCALAR", {1, 2, 4})}});
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("mesh \"Thing\", face 0 names vertex 4 of 4"));
}

TEST_F(GltfValues, StandAtTheStrideAndOffsetOfTheirView) {
  GltfBuilder gltf;
  // A normal behind each position, and four bytes before all.
  const int view = gltf.add_view<float>({-1, 0, 0, 0, 8, 8, 8, 1, 0, 0, 8, 8, 8, 0, 1, 0, 8, 8, 8});
  gltf.json["bufferViews"][static_cast<std::size_t>(view)]["byteStride"] = 24;
  const int positions = gltf.add_accessor(
      {{"bufferView", view}, {"byteOffset", 4}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  const FramePositions read = frame(gltf, positions);
  expect_vertex(read, 1, 1, 0, 0);
  expect_vertex(read, 2, 0, 1, 0);
  gltf.json["accessors"][static_cast<std::size_t>(positions)]["count"] = 4;
  EXPECT_THAT(refusal(gltf, {}).what(),
              HasSubstr("promises 4 elements, 24 bytes apart from byte 4 on, and its view "
                        "has 76 bytes"));
}

TEST_F(GltfValues, AreZerosWithoutAView) {
  GltfBuilder gltf = morphing_triangle();
  const int nothing = gltf.add_accessor({{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  gltf.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] = nothing;
  gltf.json["meshes"][0]["weights"] = {1, 1};
  const FramePositions read = frames(gltf, "1").at(0);
  expect_vertex(read, 1, 3, 0, 1);
  expect_vertex(read, 2, 0, 1, 1);
}

TEST_F(GltfValues, SparseOnesReplaceWhatIsThereOrZeros) {
  GltfBuilder gltf;
  const int numbers = gltf.add_view<std::uint16_t>({1, 2});
  const int values = gltf.add_view<float>({5, 0, 0, 0, 6, 0});
  const nlohmann::json sparse = {{"count", 2},
                                 {"indices", {{"bufferView", numbers}, {"componentType", 5123}}},
                                 {"values", {{"bufferView", values}}}};
  const int over_zeros =
      gltf.add_accessor({{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}, {"sparse", sparse}});
  FramePositions read = frame(gltf, over_zeros);
  expect_vertex(read, 0, 0, 0, 0);
  expect_vertex(read, 1, 5, 0, 0);
  expect_vertex(read, 2, 0, 6, 0);
  const int over_others = gltf.add<float>("VEC3", {1, 1, 1, 1, 1, 1, 1, 1, 1});
  gltf.json["accessors"][static_cast<std::size_t>(over_others)]["sparse"] = sparse;
  read = frame(gltf, over_others);
  expect_vertex(read, 0, 1, 1, 1);
  expect_vertex(read, 2, 0, 6, 0);
  gltf.json["accessors"][static_cast<std::size_t>(over_others)]["count"] = 2;
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("is sparse, and names element 2 of 2"));
}

TEST_F(GltfValues, SparseIndicesOverZerosAreRead) {
  GltfBuilder gltf;
  const int positions = gltf.add<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int numbers = gltf.add_view<std::uint8_t>({1, 2});
  const int values = gltf.add_view<std::uint16_t>({1, 2});
  const int indices = gltf.add_accessor({{"componentType", 5123},
                                         {"count", 3},
                                         {"type", "SCALAR"},
                                         {"sparse",
                                          {{"count", 2},
                                           {"indices", {{"bufferView", numbers}, {"componentType", 5121}}},
                                           {"values", {{"bufferView", values}}}}}});
  set_mesh(gltf, {{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
  EXPECT_EQ(open(gltf).source->mesh().faces, (std::vector<Face>{{0, 1, 2}}));
}

TEST_F(GltfValues, ThatAreTooManyForTheFileAreRefused) {
  GltfBuilder gltf = one_triangle();
  for (const std::uint64_t count : {std::uint64_t{1} << 31, std::uint64_t{1} << 62, ~std::uint64_t{0}}) {
    gltf.json["accessors"][0]["count"] = count;
    EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("scene.gltf: "));
    GltfBuilder zeros = one_triangle();
    zeros.json["accessors"][0].erase("bufferView");
    zeros.json["accessors"][0]["count"] = count;
    EXPECT_THAT(refusal(zeros, {}).what(), HasSubstr("scene.gltf: "));
  }
  GltfBuilder zeros = one_triangle();
  zeros.json["accessors"][0].erase("bufferView");
  zeros.json["accessors"][0]["count"] = 1 << 30;
  EXPECT_THAT(refusal(zeros, {}).what(),
              AllOf(HasSubstr("mesh \"Thing\", POSITION has 1073741824 elements"), HasSubstr("more than")));
}

TEST_F(GltfValues, ThatNodesMultiplyBeyondMeasureAreRefused) {
  GltfBuilder gltf;
  set_mesh(gltf, {{"attributes", {{"POSITION", gltf.add<float>("VEC3", std::vector<float>(30000, 1))}}}});
  std::vector<int> roots;
  for (int node = 0; node < 3000; ++node) {
    gltf.json["nodes"][static_cast<std::size_t>(node)] = {{"mesh", 0}};
    roots.push_back(node);
  }
  set_roots(gltf, roots);
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("the most that are read of a file of its size"));
}

TEST_F(GltfValues, OfTheWrongTypeAreNamed) {
  GltfBuilder gltf = one_triangle();
  gltf.json["accessors"][0]["type"] = "VEC2";
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("mesh \"Thing\", POSITION has 2 components"));
  GltfBuilder indices = one_triangle();
  indices.json["accessors"][1]["componentType"] = 5122;
  EXPECT_THAT(refusal(indices, {}).what(), HasSubstr("mesh \"Thing\", indices is of type 5122"));
}

/// Adds a compressed view of `count` elements and returns its number. It stands where a fallback would.
int add_compressed(GltfBuilder& gltf, const std::vector<unsigned char>& bytes, std::size_t count,
                   std::size_t stride, const std::string& mode, const std::string& filter = "NONE",
                   const std::string& extension = "EXT_meshopt_compression") {
  const int view = gltf.add_view({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  nlohmann::json& json = gltf.json["bufferViews"][static_cast<std::size_t>(view)];
  const nlohmann::json compressed = {{"buffer", 0},
                                     {"byteOffset", json["byteOffset"]},
                                     {"byteLength", bytes.size()},
                                     {"byteStride", stride},
                                     {"count", count},
                                     {"mode", mode},
                                     {"filter", filter}};
  json = {{"buffer", 1},
          {"byteOffset", 0},
          {"byteLength", count * stride},
          {"extensions", {{extension, compressed}}}};
  if (mode == "ATTRIBUTES") json["byteStride"] = stride;
  gltf.json["buffers"][1] = {{"byteLength", 1 << 20}, {"extensions", {{extension, {{"fallback", true}}}}}};
  gltf.json["extensionsRequired"] = {extension};
  return view;
}

template <class T>
std::vector<unsigned char> compressed_vertices(const std::vector<T>& values, std::size_t count) {
  const std::size_t stride = values.size() * sizeof(T) / count;
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, stride));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), values.data(), count, stride));
  return bytes;
}

TEST_F(GltfValues, MayBeCompressedByMeshoptimizer) {
  for (const std::string extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    GltfBuilder gltf;
    const std::vector<std::uint16_t> positions = {0, 0, 0, 0, 8, 0, 0, 0, 0, 9, 0, 0, 7, 9, 0, 0};
    const int view =
        add_compressed(gltf, compressed_vertices(positions, 4), 4, 8, "ATTRIBUTES", "NONE", extension);
    const int position =
        gltf.add_accessor({{"bufferView", view}, {"componentType", 5123}, {"count", 4}, {"type", "VEC3"}});
    const std::vector<std::uint32_t> corners = {0, 1, 2, 2, 1, 3};
    std::vector<unsigned char> bytes(meshopt_encodeIndexBufferBound(6, 4));
    bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), corners.data(), 6));
    const int triangles = add_compressed(gltf, bytes, 6, 2, "TRIANGLES", "NONE", extension);
    const int index = gltf.add_accessor(
        {{"bufferView", triangles}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}});
    set_mesh(gltf, {{"attributes", {{"POSITION", position}}}, {"indices", index}});
    const FramePositions read = frames(gltf, "1").at(0);
    expect_vertex(read, 1, 8, 0, 0);
    expect_vertex(read, 3, 7, 9, 0);
    EXPECT_EQ(open(gltf).source->mesh().faces.size(), 2U);

    std::vector<unsigned char> sequence(meshopt_encodeIndexSequenceBound(6, 4));
    sequence.resize(meshopt_encodeIndexSequence(sequence.data(), sequence.size(), corners.data(), 6));
    gltf.json["accessors"][static_cast<std::size_t>(index)]["bufferView"] =
        add_compressed(gltf, sequence, 6, 2, "INDICES", "NONE", extension);
    EXPECT_EQ(open(gltf).source->mesh().faces, (std::vector<Face>{{0, 1, 2}, {2, 1, 3}}));
  }
}

TEST_F(GltfValues, CompressedByALaterCodecSaySo) {
  GltfBuilder gltf;
  std::vector<unsigned char> bytes =
      compressed_vertices<std::uint16_t>({0, 0, 0, 0, 8, 0, 0, 0, 0, 9, 0, 0}, 3);
  bytes[0] = 0xae;
  const int view = add_compressed(gltf, bytes, 3, 8, "ATTRIBUTES", "NONE", "KHR_meshopt_compression");
  const int accessor =
      gltf.add_accessor({{"bufferView", view}, {"componentType", 5123}, {"count", 3}, {"type", "VEC3"}});
  set_mesh(gltf, {{"attributes", {{"POSITION", accessor}}}});
  EXPECT_THAT(refusal(gltf, {}).what(),
              HasSubstr("is of version 14 of its codec, which the library here does not read"));
}

TEST_F(GltfValues, PassTheFiltersOfMeshoptimizer) {
  GltfBuilder gltf = one_triangle();
  const std::vector<float> shift = {0, 0, 0, 3.5F, 0, -1.25F};
  std::vector<std::uint32_t> exponential(shift.size());
  meshopt_encodeFilterExp(exponential.data(), 2, 12, 15, shift.data());
  const int moved =
      add_compressed(gltf, compressed_vertices(exponential, 2), 2, 12, "ATTRIBUTES", "EXPONENTIAL");
  gltf.animate(
      0, 0, "translation", {0, 1},
      gltf.add_accessor({{"bufferView", moved}, {"componentType", 5126}, {"count", 2}, {"type", "VEC3"}}),
      "LINEAR");
  const std::vector<float> turn = {0, 0, 0, 1, 0, 0, kHalf, kHalf};
  std::vector<std::int16_t> quaternions(turn.size());
  meshopt_encodeFilterQuat(quaternions.data(), 2, 8, 16, turn.data());
  const int turned =
      add_compressed(gltf, compressed_vertices(quaternions, 2), 2, 8, "ATTRIBUTES", "QUATERNION");
  gltf.animate(0, 0, "rotation", {0, 1},
               gltf.add_accessor({{"bufferView", turned},
                                  {"componentType", 5122},
                                  {"normalized", true},
                                  {"count", 2},
                                  {"type", "VEC4"}}),
               "LINEAR");
  const FramePositions last = frames(gltf, "1").at(1);
  EXPECT_NEAR(last[0], 3.5, 1e-4);
  EXPECT_NEAR(last[2], -1.25, 1e-4);
  EXPECT_NEAR(last[3], 3.5, 1e-4);
  EXPECT_NEAR(last[4], 1, 1e-4);

  // Octahedral ones are normals; that they stand in for positions shows that they are decoded.
  GltfBuilder normals;
  const std::vector<float> directions = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0};
  std::vector<std::int8_t> octahedral(directions.size());
  meshopt_encodeFilterOct(octahedral.data(), 3, 4, 8, directions.data());
  const int view =
      add_compressed(normals, compressed_vertices(octahedral, 3), 3, 4, "ATTRIBUTES", "OCTAHEDRAL");
  const int accessor = normals.add_accessor(
      {{"bufferView", view}, {"componentType", 5120}, {"normalized", true}, {"count", 3}, {"type", "VEC3"}});
  const FramePositions read = frame(normals, accessor);
  expect_vertex(read, 0, 1, 0, 0);
  expect_vertex(read, 1, 0, 1, 0);
  expect_vertex(read, 2, 0, 0, -1);
}

TEST_F(GltfValues, RefuseWhatIsNoCompressedView) {
  GltfBuilder gltf;
  const std::vector<unsigned char> bytes =
      compressed_vertices<std::uint16_t>({0, 0, 0, 0, 8, 0, 0, 0, 0, 9, 0, 0}, 3);
  const int view = add_compressed(gltf, bytes, 3, 8, "ATTRIBUTES");
  set_mesh(gltf,
           {{"attributes",
             {{"POSITION",
               gltf.add_accessor(
                   {{"bufferView", view}, {"componentType", 5123}, {"count", 3}, {"type", "VEC3"}})}}}});
  nlohmann::json& extension =
      gltf.json["bufferViews"][static_cast<std::size_t>(view)]["extensions"]["EXT_meshopt_compression"];
  const nlohmann::json good = extension;
  const auto expect = [&](const std::string& key, const nlohmann::json& value, const std::string& part) {
    extension = good;
    extension[key] = value;
    EXPECT_THAT(refusal(gltf, {}).what(), AllOf(HasSubstr("scene.gltf: "), HasSubstr(part))) << key;
  };
  expect("count", 400, "is damaged");
  expect("count", 1 << 30, "promises 1073741824 elements of 8 bytes in");
  expect("count", 0, "promises 0 elements");
  expect("count", -1, "promises");
  expect("byteStride", 0, "has a stride of 0 bytes");
  expect("byteStride", 6, "has a stride of 6 bytes");
  expect("byteLength", 1 << 20, "view 0 goes on to byte 1048576");
  expect("buffer", 1, "buffer 1 has no bytes");
  expect("buffer", 7, "buffer 7 is named, and there are 2");
  expect("mode", "POINTS", "has the mode \"POINTS\"");
  expect("filter", "QUATERNARY",
         "has a filter \"QUATERNARY\" that does not go with its ATTRIBUTES of 8 bytes");
}

}  // namespace
}  // namespace tvg::cli
