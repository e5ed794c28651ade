#include "decoder/exporters/frame_sink.hpp"
#include "encoder/importers/open_source.hpp"
#include "tests/exporters/format_samples.hpp"
#include "tests/exporters/kept_properties.hpp"

#include <array>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>

#include <tvg/data.hpp>
#include <tvg/decoder.hpp>
#include <tvg/encoder.hpp>

// The table of docs/formats.md: what each format keeps, by files that are written and read back, and where
// they are only read, by files made here.
namespace tvg::cli {
namespace {

using namespace testing;

constexpr std::array<const char*, 10> kProperties = {"positions", "order",   "polygons",  "texcoords",
                                                     "normals",   "colours", "materials", "parts",
                                                     "skeleton",  "times"};

/// What a cell says: kept by what is written and read back, read only, or neither.
enum Cell { kNone, kRead, kKept };

struct Row {
  const char* format;
  std::array<Cell, kProperties.size()> cells;
};

constexpr Cell N = kNone, R = kRead, K = kKept;

constexpr std::array<Row, 11> kTable = {{
    {"OBJ", {K, K, K, K, K, K, K, K, N, N}},
    {"PLY", {K, K, K, K, K, K, R, R, N, N}},
    {"OFF", {K, K, K, R, R, K, N, N, N, N}},
    {"STL", {K, N, N, N, N, N, N, N, N, N}},
    {"PC2", {K, K, N, N, N, N, N, N, N, N}},
    {"MDD", {K, K, N, N, N, N, N, N, N, K}},
    {"NPY", {K, K, N, N, N, N, N, N, N, N}},
    {"PC16", {R, R, N, N, N, N, N, N, N, N}},
    {"NPZ", {R, R, N, N, N, N, N, N, N, N}},
    {"glTF", {K, K, K, K, K, K, K, K, R, K}},
    {"COLLADA", {R, N, R, R, R, R, R, R, R, N}},
}};

constexpr Row kStream = {"TVG", {K, K, K, K, K, K, K, K, K, K}};

SourceSpec spec_of(std::vector<std::string> inputs) {
  SourceSpec spec;
  spec.inputs = std::move(inputs);
  for (PropertyOptions* options : {&spec.scene.properties, &spec.sequence.properties}) {
    options->wanted = true;
    options->normals = NormalsChoice::kKeep;
  }
  spec.scene.skeleton_data = true;
  return spec;
}

Seen read_whole(FrameSource& source) {
  Seen seen{source.mesh(), source.properties(), source.metadata(), {}, {}};
  seen.data.assign(source.data().begin(), source.data().end());
  FramePositions frame(3 * std::size_t{seen.mesh.vertex_count});
  for (Result<bool> more = source.read_frame(frame); more && *more; more = source.read_frame(frame))
    seen.frames.push_back(frame);
  return seen;
}

Seen decode_whole(std::span<const std::uint8_t> stream) {
  Decoder decoder;
  decoder.push(stream);
  decoder.finish();
  Seen seen;
  for (;;) {
    switch (decoder.poll()) {
      case Decoder::Event::kMesh:
        seen.mesh = decoder.mesh();
        seen.properties = decoder.properties();
        break;
      case Decoder::Event::kMetadata:
        seen.metadata = decoder.metadata();
        break;
      case Decoder::Event::kData:
        if (auto data = unpack_data(decoder.data())) seen.data.push_back(std::move(*data));
        break;
      case Decoder::Event::kFrame:
        seen.frames.emplace_back(3 * std::size_t{decoder.mesh().vertex_count});
        decoder.copy_positions(seen.frames.back().data());
        break;
      case Decoder::Event::kEnd:
      case Decoder::Event::kError:
        return seen;
      default:
        break;
    }
  }
}

/// The whole mesh through files of a format.
Seen write_and_read(const std::string& format) {
  static const std::map<std::string, std::pair<std::string, bool>> names = {
      {"OBJ", {"a_%d.obj", false}}, {"PLY", {"a_%d.ply", false}}, {"OFF", {"a_%d.off", false}},
      {"STL", {"a_%d.stl", false}}, {"PC2", {"a.pc2", true}},     {"MDD", {"a.mdd", true}},
      {"NPY", {"a.npy", true}},     {"glTF", {"a.glb", false}}};
  const auto& [name, is_cache] = names.at(format);
  const TemporaryFolder folder;
  const auto sink = open_sink(folder.path(name), {});
  sink->add_data(two_materials());
  sink->add_data(named_data("image/wood.png", kPng));
  sink->add_data(named_data("skeleton", R"({"joints": [{"name": "hip", "parent": -1}]})"));
  whole_mesh().write(*sink, kFrameCount);
  std::vector<std::string> inputs = {folder.path(name)};
  if (is_cache) {
    // A mesh of faces alone, so that what comes back is the cache's.
    const Mesh mesh = whole_mesh().mesh;
    std::string text;
    for (std::uint32_t vertex = 0; vertex < mesh.vertex_count; ++vertex) text += "v 0 0 0\n";
    for (const Face& face : mesh.faces)
      text += fmt::format("f {} {} {}\n", face[0] + 1, face[1] + 1, face[2] + 1);
    folder.write("a.obj", text);
    inputs.push_back(folder.path("a.obj"));
  }
  return read_whole(*open_source(spec_of(inputs)).source);
}

class WholeSource final : public FrameSource {
 public:
  const Mesh& mesh() const override { return whole_.mesh; }
  const MeshProperties& properties() const override { return whole_.properties; }
  std::span<const NamedData> data() const override { return data_; }
  Metadata metadata() const override { return {{"fps", "25"}}; }
  std::optional<std::uint64_t> frame_count() const override { return kFrameCount; }
  bool rewind() override {
    next_ = 0;
    return true;
  }
  Result<bool> read_frame(std::span<float> positions) override {
    if (next_ == kFrameCount) return false;
    std::ranges::copy(whole_.frame(next_++), positions.begin());
    return true;
  }

 private:
  WholeMesh whole_ = whole_mesh();
  std::vector<NamedData> data_ = {two_materials(), named_data("image/wood.png", kPng),
                                  named_data("skeleton", R"({"joints": [{"name": "hip", "parent": -1}]})")};
  int next_ = 0;
};

Seen through_stream() {
  std::vector<std::uint8_t> stream;
  EncodeOptions options;
  options.fine_bits = options.coarse_bits = 16;
  WholeSource source;
  const auto report = encode(source, options, [&stream](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  });
  EXPECT_TRUE(report);
  return decode_whole(stream);
}

/// A file of the format, with what is only read of it.
Seen read_sample(const std::string& format, const std::string& property) {
  static const std::map<std::string, std::pair<std::string, std::string (*)()>> samples = {
      {"PLY", {"a.ply", textured_ply}},   {"OFF", {"a.off", off_with_all}},
      {"PC16", {"a.pc16", pc16_bytes}},   {"NPZ", {"a.npz", npz_of_frames}},
      {"glTF", {"a.gltf", skinned_gltf}}, {"COLLADA", {"a.dae", whole_dae}}};
  const bool is_skinned = format == "COLLADA" && property == "skeleton";
  const auto& [name, make] = samples.at(format);
  const TemporaryFolder folder;
  std::vector<std::string> inputs = {folder.write(name, is_skinned ? skinned_dae() : make())};
  if (format == "PC16" || format == "NPZ")
    inputs.push_back(
        folder.write("a.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"));
  return read_whole(*open_source(spec_of(inputs)).source);
}

/// Whether a sample has what its format holds.
bool has(const Seen& seen, const std::string& property) {
  if (property == "positions") return seen.frames.size() > 0 && seen.mesh.vertex_count > 2;
  if (property == "order") return seen.mesh.faces == kTetrahedron;
  if (property == "polygons") return seen.properties.polygons.size() == 1;
  if (property == "texcoords") return find(seen.properties, AttributeKind::kTexcoord) != nullptr;
  if (property == "normals") return find(seen.properties, AttributeKind::kNormal) != nullptr;
  if (property == "colours") return find(seen.properties, AttributeKind::kColour) != nullptr;
  if (property == "parts")
    return !seen.properties.parts.empty() && !seen.properties.parts[0].material.empty();
  return has_data(seen, property);
}

class FormatKeeps : public ::testing::TestWithParam<std::pair<std::size_t, std::size_t>> {};

TEST_P(FormatKeeps, WhatTheTableSays) {
  const Row& row = kTable[GetParam().first];
  const std::string property = kProperties[GetParam().second];
  const Cell cell = row.cells[GetParam().second];
  // A format that is written is read back; what is lost on the way may still be read of other files.
  const bool is_written = row.cells[0] == kKept;
  if (is_written) {
    EXPECT_EQ(keeps(write_and_read(row.format), property), cell == kKept);
  }
  if (cell == kRead || (!is_written && property != "times")) {
    EXPECT_EQ(has(read_sample(row.format, property), property), cell == kRead);
  }
}

std::vector<std::pair<std::size_t, std::size_t>> all_cells() {
  std::vector<std::pair<std::size_t, std::size_t>> cells;
  for (std::size_t row = 0; row < kTable.size(); ++row) {
    for (std::size_t column = 0; column < kProperties.size(); ++column) cells.emplace_back(row, column);
  }
  return cells;
}

INSTANTIATE_TEST_SUITE_P(Formats, FormatKeeps, ::testing::ValuesIn(all_cells()), [](const auto& tested) {
  return std::string(kTable[tested.param.first].format) + "_" + kProperties[tested.param.second];
});

TEST(FormatTable, AStreamKeepsAll) {
  const Seen seen = through_stream();
  for (std::size_t column = 0; column < kProperties.size(); ++column)
    EXPECT_EQ(keeps(seen, kProperties[column]), kStream.cells[column] == kKept) << kProperties[column];
}

/// A row as the page has it.
std::string line_of(const Row& row) {
  static constexpr std::array<const char*, 3> kWords = {"", "read", "yes"};
  std::string line = std::string("| ") + row.format + " |";
  for (const Cell cell : row.cells) line += cell == kNone ? " |" : std::string(" ") + kWords[cell] + " |";
  return line;
}

TEST(FormatTable, ThePageHasTheSame) {
  std::ifstream file(std::string(TVG_PROJECT) + "/docs/formats.md", std::ios::binary);
  const std::string page{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::string table = "| |";
  for (const char* property : kProperties) table += std::string(" ") + property + " |";
  table += "\n|";
  for (std::size_t i = 0; i <= kProperties.size(); ++i) table += "---|";
  table += "\n";
  for (const Row& row : kTable) table += line_of(row) + "\n";
  table += line_of(kStream) + "\n\n";
  EXPECT_NE(page.find(table), std::string::npos) << "docs/formats.md should have\n" << table;
}

}  // namespace
}  // namespace tvg::cli
