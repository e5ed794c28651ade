#include "stream_facts.hpp"
#include "streams.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>

// tvg_make_conformance FOLDER: writes every conformance stream, digests.txt and lods.txt, and takes away
// streams that are no longer made.
namespace {

bool write_file(const std::filesystem::path& path, std::string_view text) {
  std::ofstream file(path, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file) std::fprintf(stderr, "tvg_make_conformance: cannot write %s\n", path.c_str());
  return static_cast<bool>(file);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: tvg_make_conformance FOLDER\n");
    return 1;
  }
  const std::filesystem::path folder = argv[1];
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
    if (entry.path().extension() == ".tvg") std::filesystem::remove(entry.path(), failed);
  }
  std::string digests = tvg::conformance::facts_heading() + "\n", lods = digests;
  for (const auto& stream : tvg::conformance::conformance_streams()) {
    const std::vector<std::uint8_t> bytes = stream.make();
    const std::string name(stream.name);
    for (std::uint32_t lod = 0; lod <= stream.lods; ++lod) {
      const auto facts = tvg::conformance::read_stream_facts(bytes, lod);
      if (!facts) {
        std::fprintf(stderr, "tvg_make_conformance: %s does not decode: %s\n", name.c_str(),
                     facts.error().describe().c_str());
        return 4;
      }
      if (lod == 0) digests += tvg::conformance::facts_line({name, *facts}) + "\n";
      if (lod > 0)
        lods += tvg::conformance::facts_line({tvg::conformance::lod_name(name, lod), *facts}) + "\n";
    }
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!write_file(folder / (name + ".tvg"), text)) return 2;
  }
  return write_file(folder / "digests.txt", digests) && write_file(folder / "lods.txt", lods) ? 0 : 2;
}
