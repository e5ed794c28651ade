#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

// Promises about the source tree itself.
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = TVG_SOURCE_DIR;

std::string read(const fs::path& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::set<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) found.insert((*i)[1]);
  return found;
}

/// The sources of the decoder's library and every header of the project that they reach.
std::set<fs::path> decoder_files() {
  std::vector<fs::path> left;
  std::istringstream sources(TVG_DECODER_SOURCES);
  for (std::string source; std::getline(sources, source, ',');) left.push_back(kRoot / "libcodec" / source);
  std::set<fs::path> reached;
  while (!left.empty()) {
    const fs::path file = left.back();
    left.pop_back();
    if (!reached.insert(file).second) continue;
    const std::string text = read(file);
    for (const std::string& name : matches(text, "#include \"([^\"]+)\""))
      left.push_back(kRoot / "libcodec" / name);
    for (const std::string& name : matches(text, "#include <(tvg/[^>]+)>")) {
      left.push_back(kRoot / "libcodec/include" / name);
    }
  }
  return reached;
}

/// Folders and files of libcodec, each of which may know those before it and no other.
const std::vector<std::string> kLibraryOrder = {
    "include",      "base",        "entropy", "container",  "geometry", "connectivity",
    "quantization", "prediction",  "planes",  "attributes", "basis",    "modes",
    "decoder",      "decoder.cpp", "source",  "measure",    "simplify", "metrics",
    "encoder",      "encoder.cpp", "streams", "c_api"};

/// The same of the top level; those of one line do not know each other.
const std::vector<std::set<std::string>> kTopOrder = {
    {"libcodec"}, {"tool"}, {"encoder", "decoder", "server", "player", "codecs"}, {"cli"}};

std::size_t library_rank(const std::string& folder) {
  const auto place = std::find(kLibraryOrder.begin(), kLibraryOrder.end(), folder);
  EXPECT_NE(place, kLibraryOrder.end()) << "libcodec/" << folder << " has no place in the order";
  return static_cast<std::size_t>(place - kLibraryOrder.begin());
}

std::size_t top_rank(const std::string& folder) {
  for (std::size_t i = 0; i < kTopOrder.size(); ++i) {
    if (kTopOrder[i].count(folder) > 0) return i;
  }
  ADD_FAILURE() << folder << "/ has no place in the order";
  return 0;
}

/// The first part of a path: "modes" of "modes/gop_decoder.hpp".
std::string first_part(const std::string& path) {
  return path.substr(0, path.find('/'));
}

/// Every file below `folder` that is C or C++, relative to it.
std::vector<std::string> sources_below(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string suffix = entry.path().extension().string();
    if (suffix == ".cpp" || suffix == ".hpp" || suffix == ".h" || suffix == ".c")
      files.push_back(fs::relative(entry.path(), folder).generic_string());
  }
  return files;
}

TEST(Layout, NoIncludeInsideTheLibraryRunsUpwards) {
  const fs::path library = kRoot / "libcodec";
  for (const std::string& file : sources_below(library)) {
    const std::string text = read(library / file);
    const std::size_t rank = library_rank(first_part(file));
    for (const std::string& header : matches(text, "#include \"([^\"]+)\"")) {
      EXPECT_LE(library_rank(first_part(header)), rank) << file << " includes " << header;
    }
    if (first_part(file) != "include") continue;
    EXPECT_TRUE(matches(text, "#include \"([^\"]+)\"").empty()) << file << " includes what is not public";
  }
}

TEST(Layout, NoIncludeAtTheTopRunsUpwardsOrSideways) {
  for (const std::set<std::string>& folders : kTopOrder) {
    for (const std::string& folder : folders) {
      if (folder == "libcodec") continue;
      for (const std::string& file : sources_below(kRoot / folder)) {
        for (const std::string& header : matches(read(kRoot / folder / file), "#include \"([^\"]+)\"")) {
          const std::string other = first_part(header);
          EXPECT_TRUE(other == folder || top_rank(other) < top_rank(folder))
              << folder << "/" << file << " includes " << header;
        }
      }
    }
  }
}

/// The rooms of the tool and the namespace of each; what is below it is the room's own.
const std::vector<std::pair<std::string, std::string>> kNamespaces = {
    {"tool", "tvg::cli"},      {"encoder", "tvg::cli"},  {"decoder", "tvg::cli"}, {"server", "tvg::server"},
    {"player", "tvg::player"}, {"codecs", "tvg::bench"}, {"cli", "tvg::cli"}};

TEST(Layout, EveryRoomHasItsNamespace) {
  for (const auto& [folder, name] : kNamespaces) {
    for (const std::string& file : sources_below(kRoot / folder)) {
      for (const std::string& opened : matches(read(kRoot / folder / file), "\nnamespace (tvg[a-z_:]*)")) {
        EXPECT_TRUE(opened == name || opened.rfind(name + "::", 0) == 0)
            << folder << "/" << file << " has " << opened;
      }
    }
  }
}

TEST(Layout, NoFileIsLongerThanFourHundredLines) {
  for (const char* folder : {"libcodec", "tool", "encoder", "decoder", "server", "player", "codecs", "cli",
                             "corpus", "bench", "examples", "tests"}) {
    for (const std::string& file : sources_below(kRoot / folder)) {
      const std::string text = read(kRoot / folder / file);
      EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 400) << folder << "/" << file;
    }
  }
}

TEST(Layout, DecoderReachesNoEncoderHeader) {
  const std::set<fs::path> files = decoder_files();
  ASSERT_GT(files.size(), 15u);
  const std::regex encoder_only("_encode\\.|encoder\\.|/measure/|/metrics/|/simplify/|stream_writer");
  for (const fs::path& file : files) {
    const std::string name = fs::relative(file, kRoot).generic_string();
    EXPECT_FALSE(std::regex_search(name, encoder_only)) << name;
  }
}

TEST(Layout, DecoderIncludesNoLibraryButXxhash) {
  for (const fs::path& file : decoder_files()) {
    for (const std::string& header : matches(read(file), "#include <([^>]+)>")) {
      const bool standard = header.find('/') == std::string::npos && header.find('.') == std::string::npos;
      const bool own = header.rfind("tvg/", 0) == 0;
      EXPECT_TRUE(standard || own || header == "xxhash.h" || header == "emmintrin.h" ||
                  header == "immintrin.h")
          << header << " in " << file;
    }
  }
}

TEST(Layout, EverySectionThatCodeNamesStandsInTheSpecification) {
  const std::set<std::string> headings =
      matches(read(kRoot / "format-spec/tvg.md"), "\n#+ ([0-9]+(?:\\.[0-9]+)*)");
  ASSERT_GT(headings.size(), 30u);
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "libcodec")) {
    if (!entry.is_regular_file()) continue;
    for (const std::string& section : matches(read(entry.path()), "§([0-9]+(?:\\.[0-9]+)*)")) {
      EXPECT_TRUE(headings.count(section)) << "§" << section << " in " << entry.path();
    }
  }
}

TEST(Layout, EverySectionOfTheSpecificationIsNamedInCode) {
  std::set<std::string> named;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "libcodec")) {
    if (entry.is_regular_file()) named.merge(matches(read(entry.path()), "§([0-9]+(?:\\.[0-9]+)*)"));
  }
  // Sections that say nothing a decoder does by itself; a section of four levels belongs to the one above.
  const std::set<std::string> without_code = {"2.1", "4.4"};
  const std::set<std::string> headings =
      matches(read(kRoot / "format-spec/tvg.md"), "\n### ([0-9]+\\.[0-9]+)");
  for (const std::string& section : headings) {
    const bool covered = named.count(section) > 0 || without_code.count(section) > 0;
    EXPECT_TRUE(covered) << "§" << section << " has no code";
  }
}

}  // namespace
