#include "stream_facts.hpp"
#include "streams.hpp"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <set>
#include <string>

namespace tvg::conformance {
namespace {

const std::filesystem::path kFolder = TVG_CONFORMANCE_FOLDER;

std::vector<std::uint8_t> read_stored(const std::string& name) {
  std::ifstream file(kFolder / (name + ".tvg"), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<NamedFacts> stored_facts() {
  std::ifstream file(kFolder / "digests.txt");
  return read_facts(file);
}

TEST(Conformance, EveryStoredStreamDecodesToItsDigests) {
  const std::vector<NamedFacts> entries = stored_facts();
  ASSERT_EQ(entries.size(), conformance_streams().size());
  for (const NamedFacts& expected : entries) {
    const Result<StreamFacts> facts = read_stream_facts(read_stored(expected.name));
    ASSERT_TRUE(facts) << expected.name << ": " << facts.error().describe();
    EXPECT_EQ(facts_line({expected.name, *facts}), facts_line(expected));
  }
}

TEST(Conformance, EveryLodDecodesToItsDigests) {
  for (const std::string folder : {"", "random/"}) {
    std::ifstream file(kFolder / (folder + "lods.txt"));
    const std::vector<NamedFacts> entries = read_facts(file);
    EXPECT_GE(entries.size(), 6u);
    for (const NamedFacts& expected : entries) {
      const std::size_t at = expected.name.find('@');
      const auto lod = static_cast<std::uint32_t>(std::stoul(expected.name.substr(at + 1)));
      const auto facts = read_stream_facts(read_stored(folder + expected.name.substr(0, at)), lod);
      ASSERT_TRUE(facts) << expected.name << ": " << facts.error().describe();
      EXPECT_EQ(facts_line({expected.name, *facts}), facts_line(expected));
    }
  }
}

/// Valid streams of another writer than the encoder: metadata late and twice, meshes used again, channels and
/// packets that may be skipped, odd labels.
TEST(Conformance, StreamsOfAnotherWriterDecodeToTheirDigests) {
  std::ifstream file(kFolder / "random" / "digests.txt");
  const std::vector<NamedFacts> entries = read_facts(file);
  EXPECT_GE(entries.size(), 10u);
  for (const NamedFacts& expected : entries) {
    const Result<StreamFacts> facts = read_stream_facts(read_stored("random/" + expected.name));
    ASSERT_TRUE(facts) << expected.name << ": " << facts.error().describe();
    EXPECT_EQ(facts_line({expected.name, *facts}), facts_line(expected));
  }
}

TEST(Conformance, TheEncoderStillMakesTheStoredBytes) {
  std::set<std::string> names;
  for (const ConformanceStream& stream : conformance_streams()) {
    const std::string name(stream.name);
    EXPECT_TRUE(!stream.same_everywhere || stream.make() == read_stored(name))
        << name << ": the format has changed; if that is meant, run tvg_make_conformance corpus/conformance";
    names.insert(name);
  }
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    if (entry.path().extension() != ".tvg") continue;
    EXPECT_TRUE(names.contains(entry.path().stem())) << entry.path();
    EXPECT_LE(entry.file_size(), 4096u) << entry.path() << " is too large for exhaustive damage";
  }
}

}  // namespace
}  // namespace tvg::conformance
