#include "stream_facts.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

// tvg_digest [--lod K] STREAM.tvg...: the lines of corpus/conformance/digests.txt for these streams, from the
// decoder alone; or those of lods.txt.
namespace {

using tvg::conformance::StreamFacts;

bool read_file(const char* path, std::vector<std::uint8_t>& bytes) {
  std::FILE* const file = std::fopen(path, "rb");
  if (file == nullptr) return false;
  std::uint8_t piece[4096];
  for (std::size_t count = 0; (count = std::fread(piece, 1, sizeof piece, file)) > 0;) {
    bytes.insert(bytes.end(), piece, piece + count);
  }
  const bool complete = std::ferror(file) == 0;
  std::fclose(file);
  return complete;
}

/// "triangle" of "corpus/conformance/triangle.tvg".
std::string stream_name(const std::string& path) {
  const std::size_t folder_end = path.find_last_of("/\\");
  const std::string name = folder_end == std::string::npos ? path : path.substr(folder_end + 1);
  return name.substr(0, name.rfind('.'));
}

}  // namespace

int main(int count, char** arguments) {
  std::puts(tvg::conformance::facts_heading().c_str());
  int status = 0, first = 1;
  std::uint32_t lod = 0;
  if (count > 2 && std::string(arguments[1]) == "--lod") {
    lod = static_cast<std::uint32_t>(std::strtoul(arguments[2], nullptr, 10));
    first = 3;
  }
  for (int i = first; i < count; ++i) {
    std::vector<std::uint8_t> bytes;
    if (!read_file(arguments[i], bytes)) {
      std::fprintf(stderr, "%s cannot be read\n", arguments[i]);
      status = 2;
      continue;
    }
    const tvg::Result<StreamFacts> facts = tvg::conformance::read_stream_facts(bytes, lod);
    if (facts) {
      std::string name = stream_name(arguments[i]);
      if (lod > 0) name = tvg::conformance::lod_name(name, lod);
      std::puts(tvg::conformance::facts_line({name, *facts}).c_str());
    } else {
      std::fprintf(stderr, "%s: %s\n", arguments[i], facts.error().describe().c_str());
      status = 3;
    }
  }
  return status;
}
