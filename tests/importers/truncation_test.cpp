#include "encoder/importers/import_error.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/open_source.hpp"
#include "tests/importers/sample_files.hpp"

#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Parser = void (*)(const std::string&, std::string_view, MeshFile&);

/// Lengths of the strict prefixes that a reader accepts. Each prefix is an allocation of its own, so that a
/// sanitizer sees a read behind it.
std::vector<std::size_t> accepted_prefixes(Parser parser, const std::string& bytes) {
  std::vector<std::size_t> accepted;
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const std::vector<char> prefix(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    MeshFile mesh;
    try {
      parser("cut", {prefix.data(), prefix.size()}, mesh);
      accepted.push_back(length);
    } catch (const ImportError& error) {
      EXPECT_THAT(error.what(), HasSubstr("cut"));
    }
  }
  return accepted;
}

TEST(Truncation, ObjAcceptsOnlyCutsBetweenLinesOfFacesAndBehindAThirdCorner) {
  const std::string text = sample_obj();
  // OBJ has no counts: a cut between two lines, when all vertices and one face are there, is a mesh with
  // fewer faces; one behind a third corner may be a file whose last line lacks its end, and is noted.
  std::vector<std::size_t> between_faces;
  for (std::size_t end = text.find('\n', text.find("\nf ") + 1); end + 1 < text.size();
       end = text.find('\n', end + 1)) {
    between_faces.push_back(end + 1);
  }
  EXPECT_EQ(between_faces.size(), 3U);
  for (const std::size_t length : accepted_prefixes(parse_obj, text)) {
    MeshFile mesh;
    parse_obj("cut", text.substr(0, length), mesh);
    const bool whole_line =
        std::find(between_faces.begin(), between_faces.end(), length) != between_faces.end();
    const bool noted = std::any_of(mesh.notes.begin(), mesh.notes.end(), [](const std::string& note) {
      return note.find("no line end") != note.npos;
    });
    EXPECT_EQ(noted, !whole_line) << length;
  }
}

TEST(Truncation, OffRefusesEveryPrefixButOneWithoutItsLastLineEnd) {
  EXPECT_THAT(accepted_prefixes(parse_off, sample_off()), ElementsAre(sample_off().size() - 1));
}

TEST(Truncation, AsciiPlyRefusesEveryPrefixButOneWithoutItsLastLineEnd) {
  EXPECT_THAT(accepted_prefixes(parse_ply, sample_ply_ascii()), ElementsAre(sample_ply_ascii().size() - 1));
}

TEST(Truncation, BinaryPlyRefusesEveryPrefix) {
  EXPECT_THAT(accepted_prefixes(parse_ply, sample_ply_binary(false)), IsEmpty());
  EXPECT_THAT(accepted_prefixes(parse_ply, sample_ply_binary(true)), IsEmpty());
}

TEST(Truncation, AsciiStlAcceptsOnlyCutsBehindTheWordEndsolid) {
  const std::string text = sample_stl_ascii();
  std::vector<std::size_t> behind_the_mesh;
  for (std::size_t length = text.find("endsolid") + 8; length < text.size(); ++length) {
    behind_the_mesh.push_back(length);
  }
  EXPECT_EQ(accepted_prefixes(parse_stl, text), behind_the_mesh);
}

TEST(Truncation, BinaryStlRefusesEveryPrefix) {
  EXPECT_THAT(accepted_prefixes(parse_stl, sample_stl_binary(tetrahedron_positions(0))), IsEmpty());
}

TEST(Truncation, CachesRefuseEveryPrefixBeforeTheFirstFrameIsRead) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("t.obj", sample_obj());
  const std::vector<std::pair<std::string, std::string>> caches = {{"t.pc2", pc2_bytes(4, 3, 3)},
                                                                   {"t.mdd", mdd_bytes(4, 3, 3, 0.04)}};
  for (const auto& [name, bytes] : caches) {
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      const std::string cache = folder.write(name, std::string_view(bytes).substr(0, length));
      const ToolError error = thrown_by([&] { open_source({{mesh, cache}, {}}); });
      EXPECT_EQ(error.status(), ExitStatus::kInvalidInput) << length;
      const std::string place = length == 0 ? "empty" : "ends at byte " + std::to_string(length) + " inside";
      EXPECT_THAT(error.what(), HasSubstr(place));
    }
    EXPECT_EQ(read_all(*open_source({{mesh, folder.write(name, bytes)}, {}}).source).frames.size(), 3U);
  }
}

}  // namespace
}  // namespace tvg::cli
