#include "stream_facts.hpp"
#include "streams.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>

// tvg_make_conformance FOLDER: writes every conformance stream and digests.txt, and takes away streams that
// are no longer made.
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
  std::string digests = tvg::conformance::facts_heading() + "\n";
  for (const auto& stream : tvg::conformance::conformance_streams()) {
    const std::vector<std::uint8_t> bytes = stream.make();
    const auto facts = tvg::conformance::read_stream_facts(bytes);
    if (!facts) {
      std::fprintf(stderr, "tvg_make_conformance: %s does not decode: %s\n", stream.name.data(),
                   facts.error().describe().c_str());
      return 4;
    }
    digests += tvg::conformance::facts_line({std::string(stream.name), *facts}) + "\n";
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!write_file(folder / (std::string(stream.name) + ".tvg"), text)) return 2;
  }
  return write_file(folder / "digests.txt", digests) ? 0 : 2;
}
