#include "container/chunk.hpp"
#include "container/mesh_payload.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>
#include <vector>

// tvg_make_seeds STREAMS FOLDER: turns the valid streams of corpus/conformance into seeds for each fuzz
// target in a folder of its name.
namespace {

namespace fs = std::filesystem;

bool write_file(const fs::path& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) std::fprintf(stderr, "tvg_make_seeds: cannot write %s\n", path.c_str());
  return static_cast<bool>(file);
}

/// The decoder's seeds: options and size of pieces in front of the stream.
bool write_decoder_seeds(const fs::path& folder, const std::string& name,
                         const std::vector<std::uint8_t>& stream) {
  constexpr std::array<std::array<std::uint8_t, 2>, 5> kStarts = {
      {{0, 1}, {2, 0}, {3, 61}, {0x12, 0}, {0x20, 61}}};
  for (const auto& start : kStarts) {
    std::vector<std::uint8_t> seed(start.begin(), start.end());
    seed.insert(seed.end(), stream.begin(), stream.end());
    if (!write_file(folder / (name + "-" + std::to_string(start[0])), seed)) return false;
  }
  return true;
}

/// The seeds of join and relay: options, and the range of frames and size of pieces in front of the stream.
bool write_streams_seeds(const fs::path& folder, const std::string& name,
                         const std::vector<std::uint8_t>& stream) {
  constexpr std::array<std::array<std::uint8_t, 2>, 4> kStarts = {{{0, 0}, {2, 61}, {7, 0}, {8, 0x10}}};
  for (const auto& start : kStarts) {
    std::vector<std::uint8_t> seed(start.begin(), start.end());
    seed.insert(seed.end(), stream.begin(), stream.end());
    if (!write_file(folder / (name + "-" + std::to_string(start[0])), seed)) return false;
  }
  return true;
}

/// The C interface's seeds: options, calls in front of the stream as c_api_fuzz.cpp reads them.
bool write_c_api_seeds(const fs::path& folder, const std::string& name,
                       const std::vector<std::uint8_t>& stream) {
  const std::vector<std::uint8_t> pushes = {0xF9, 6, 6, 6, 0xF8, 6, 0x21, 6, 6};
  const std::vector<std::uint8_t> coarse = {0xAA, 0xF9, 6, 6, 4, 6, 0xF9, 4, 6, 6, 6};  // of lod 1
  const std::vector<std::uint8_t> seeks = {0xF9, 6, 6, 6, 5, 0x23, 4, 0xF9, 6, 6, 6, 0x0B, 0xF9, 4, 6, 6};
  for (const auto& calls : {pushes, coarse, seeks}) {
    std::vector<std::uint8_t> seed = {2, static_cast<std::uint8_t>(calls.size())};
    seed.insert(seed.end(), calls.begin(), calls.end());
    seed.insert(seed.end(), stream.begin(), stream.end());
    if (!write_file(folder / (name + "-" + std::to_string(calls.size())), seed)) return false;
  }
  return true;
}

/// The seeds of encoding in C: scripts as encoder_script.cpp reads them, which take no stream.
bool write_encoder_seeds(const fs::path& folder) {
  constexpr std::uint8_t kCreate = 0, kMetadata = 1, kMesh = 2, kWildFrame = 3, kFrames = 4, kFinish = 6;
  constexpr std::uint8_t kJoin = 7 | 1 << 3, kCompare = 7;
  const std::vector<std::uint8_t> square = {kMesh, 4, 2, 0, 1, 2, 0, 2, 3};
  const std::vector<std::vector<std::uint8_t>> starts = {
      {kCreate},
      {kCreate | 1 << 3, 13, 9},                                  // bits
      {kCreate | 2 << 3, 100, 3, kMetadata | 26 << 3, 'k', 'v'},  // step
      {kCreate | 4 << 3, 90, 40, 2, 3, 1, 1, 0, 0, 0, 9, 4},      // share, predictor, GOPs, order
      {kCreate | 8 << 3, 2, 30, 30, 1, 180, 200, 180, 200, 180, 200, 180, 100, 180, 100, 180, 100, 2,
       0},                                                                                  // box
      {kCreate | 8 << 3, 2, 30, 30, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 1, 5, 3, 0},  // basis
      {kCreate | 16 << 3, 5},  // a sink that gives up
  };
  std::vector<std::uint8_t> all;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    std::vector<std::uint8_t> seed = starts[i];
    const auto add = [&seed](std::initializer_list<int> calls) {
      for (const int call : calls) seed.push_back(static_cast<std::uint8_t>(call));
    };
    seed.insert(seed.end(), square.begin(), square.end());
    add({kFrames | 6 << 3, 7, kWildFrame, 9, 2, 3, 40, 112, 8, 20, 60, 116, 1});
    seed.insert(seed.end(), square.begin(), square.end());
    add({kFrames | 2 << 3, 8, kFinish, kCompare, kJoin});
    if (!write_file(folder / ("script-" + std::to_string(i)), seed)) return false;
    all.insert(all.end(), seed.begin(), seed.end());
  }
  return write_file(folder / "script-all", all);
}

/// The connectivity decoder's seeds: one for each mesh, in the layout that connectivity_fuzz.cpp gives.
bool write_connectivity_seeds(const fs::path& folder, const std::string& name, tvg::Bytes stream) {
  int number = 0;
  for (tvg::Bytes rest = stream.subspan(tvg::kSignature.size()); !rest.empty();) {
    const auto header = tvg::read_chunk_header(rest);
    if (!header || header->total_size() > rest.size()) return false;
    if (header->type == tvg::kMeshChunk) {
      const auto mesh = tvg::read_mesh(rest.subspan(tvg::kChunkHeaderSize, header->length));
      if (!mesh) return false;
      tvg::ByteWriter seed;
      seed.u16(static_cast<std::uint16_t>(mesh->vertex_count));
      seed.u16(static_cast<std::uint16_t>(mesh->face_count));
      seed.u16(static_cast<std::uint16_t>(mesh->connectivity.size()));
      seed.bytes(mesh->connectivity);
      seed.bytes(mesh->order);
      if (!write_file(folder / (name + "-" + std::to_string(number++)), seed.take())) return false;
    }
    rest = rest.subspan(static_cast<std::size_t>(header->total_size()));
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: tvg_make_seeds STREAMS FOLDER\n");
    return 1;
  }
  const fs::path target = argv[2];
  std::error_code failed;
  fs::create_directories(target / "decoder_fuzz", failed);
  fs::create_directories(target / "connectivity_fuzz", failed);
  fs::create_directories(target / "c_api_fuzz", failed);
  fs::create_directories(target / "c_api_encoder_fuzz", failed);
  fs::create_directories(target / "streams_fuzz", failed);
  if (!write_encoder_seeds(target / "c_api_encoder_fuzz")) return 3;
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(argv[1], failed)) {
    if (entry.path().extension() != ".tvg" || entry.path().parent_path().filename() == "negative") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    const std::vector<std::uint8_t> stream{std::istreambuf_iterator<char>(file),
                                           std::istreambuf_iterator<char>()};
    const std::string name = entry.path().stem();
    if (stream.size() < tvg::kSignature.size() ||
        !write_decoder_seeds(target / "decoder_fuzz", name, stream) ||
        !write_streams_seeds(target / "streams_fuzz", name, stream) ||
        !write_c_api_seeds(target / "c_api_fuzz", name, stream) ||
        !write_connectivity_seeds(target / "connectivity_fuzz", name, stream)) {
      std::fprintf(stderr, "tvg_make_seeds: no seeds from %s\n", entry.path().c_str());
      return 3;
    }
    ++count;
  }
  if (count == 0) std::fprintf(stderr, "tvg_make_seeds: no streams in %s\n", argv[1]);
  return count > 0 ? 0 : 3;
}
