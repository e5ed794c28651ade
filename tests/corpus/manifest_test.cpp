#include "corpus/corpus.hpp"
#include "corpus/exact_math.hpp"

#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

namespace tvg::corpus {
namespace {

struct ManifestRow {
  std::string name, size;
  std::uint32_t vertices = 0;
  std::size_t faces = 0, frames = 0;
  std::string frames_digest, faces_digest;
};

/// The rows of the manifest's table of digests: those with seven cells whose last is a digest.
std::vector<ManifestRow> read_manifest() {
  std::ifstream file(TVG_CORPUS_MANIFEST);
  std::vector<ManifestRow> rows;
  for (std::string line; std::getline(file, line);) {
    for (char& c : line) c = c == '|' ? ' ' : c;
    std::istringstream cells(line);
    ManifestRow row;
    if (cells >> row.name >> row.size >> row.vertices >> row.faces >> row.frames >> row.frames_digest >>
        row.faces_digest) {
      rows.push_back(row);
    }
  }
  return rows;
}

std::string hexadecimal(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

TEST(Manifest, EverySequenceHasTheDigestsWrittenThere) {
  const std::vector<ManifestRow> rows = read_manifest();
  ASSERT_EQ(rows.size(), 2 * corpus_entries().size());
  for (const ManifestRow& row : rows) {
    const CorpusEntry* entry = find_corpus_entry(row.name);
    const auto size = named_size(row.size);
    ASSERT_NE(entry, nullptr) << row.name;
    ASSERT_TRUE(size.has_value()) << row.size;
    const Sequence sequence = entry->make(*size).sequence;
    EXPECT_EQ(sequence.mesh.vertex_count, row.vertices) << row.name << ' ' << row.size;
    EXPECT_EQ(sequence.mesh.faces.size(), row.faces) << row.name << ' ' << row.size;
    EXPECT_EQ(sequence.frames.size(), row.frames) << row.name << ' ' << row.size;
    EXPECT_EQ(hexadecimal(frames_digest(sequence)), row.frames_digest) << row.name << ' ' << row.size;
    EXPECT_EQ(hexadecimal(faces_digest(sequence.mesh)), row.faces_digest) << row.name << ' ' << row.size;
  }
}

TEST(Digest, IsXxh64OfLittleEndianWords) {
  // XXH64 with seed 0 of no bytes, and of the bytes 00 00 80 3f (1.0F).
  Sequence sequence;
  EXPECT_EQ(hexadecimal(frames_digest(sequence)), "ef46db3751d8e999");
  sequence.frames = {{1.0F}};
  const std::uint64_t one = frames_digest(sequence);
  sequence.frames = {{}, {1.0F}};
  EXPECT_EQ(frames_digest(sequence), one);
  sequence.frames = {{-1.0F}};
  EXPECT_NE(frames_digest(sequence), one);
  EXPECT_EQ(faces_digest(Mesh{3, {{0, 1, 2}}}), faces_digest(Mesh{9, {{0, 1, 2}}}));
  EXPECT_NE(faces_digest(Mesh{3, {{0, 1, 2}}}), faces_digest(Mesh{3, {{1, 2, 0}}}));
}

TEST(ExactMath, SineIsAccurate) {
  for (int i = -4000; i <= 4000; ++i) {
    const double turns = i / 1000.0;
    EXPECT_NEAR(sine(turns), std::sin(turns * 6.283185307179586), 1e-11);
    EXPECT_NEAR(cosine(turns), std::cos(turns * 6.283185307179586), 1e-11);
  }
  EXPECT_EQ(sine(0), 0);
  EXPECT_EQ(sine(0.5), 0);
}

TEST(ExactMath, RotationTurnsCounterClockwiseAboutItsCentre) {
  const Pose quarter = rotation_about({1, 0, 0}, {0, 0, 1}, 0.25);
  const Vec3 turned = quarter.apply({2, 0, 5});
  EXPECT_NEAR(turned.x, 1, 1e-10);
  EXPECT_NEAR(turned.y, 1, 1e-10);
  EXPECT_NEAR(turned.z, 5, 1e-10);
  // The inner motion comes first: shift to (2, 0, 5), then turn.
  const Vec3 combined = quarter.after(translation_by({1, 0, 0})).apply({1, 0, 5});
  EXPECT_NEAR(combined.x, 1, 1e-10);
  EXPECT_NEAR(combined.y, 1, 1e-10);
}

}  // namespace
}  // namespace tvg::corpus
