// Decodes a whole file to memory, then goes back to a frame by the file's index:
//   decode_to_memory clip.tvg 42
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

#include <tvg/stream_decoder.hpp>

namespace {

using Frames = std::vector<std::vector<float>>;  // [frame][vertex * 3 + axis]

/// Decodes from `offset` on until `most` frames are there or the stream ends. False where it is broken.
bool decode(tvg::StreamDecoder& decoder, const std::vector<char>& file, std::uint64_t offset,
            std::size_t most, Frames& frames) {
  while (frames.size() < most) {
    switch (decoder.poll()) {
      case TVG_EVENT_NEED_BYTES:
        offset += decoder.skip();
        if (offset < file.size()) decoder.push(file.data() + offset, file.size() - offset);
        decoder.finish();
        offset = file.size();
        break;
      case TVG_EVENT_FRAME: {
        std::vector<float>& frame = frames.emplace_back(3 * std::size_t{decoder.mesh()->vertex_count});
        decoder.copy_positions(frame.data(), frame.size());
        break;
      }
      case TVG_EVENT_DAMAGE:
        std::fprintf(stderr, "%s\n", decoder.damage()->text);
        return false;
      case TVG_EVENT_ERROR:
        std::fprintf(stderr, "%s\n", decoder.error_text().c_str());
        return false;
      case TVG_EVENT_END:
        return true;
      default:
        break;
    }
  }
  return true;
}

bool load_index(tvg::StreamDecoder& decoder, const std::vector<char>& file) {
  std::uint64_t offset = 0, size = 0;
  return file.size() >= TVG_TAIL_BYTES &&
         tvg_locate_index(file.data() + file.size() - TVG_TAIL_BYTES, TVG_TAIL_BYTES, file.size(), &offset,
                          &size) == TVG_OK &&
         decoder.load_index(file.data() + offset, size) == TVG_OK;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: decode_to_memory FILE FRAME\n"), 1;
  std::ifstream input(argv[1], std::ios::binary);
  const std::vector<char> file(std::istreambuf_iterator<char>(input), {});

  tvg::StreamDecoder decoder;
  Frames all;
  if (!decoder || !decode(decoder, file, 0, SIZE_MAX, all)) return 1;
  std::printf("%zu frames at %s frames per second\n", all.size(),
              decoder.metadata("fps").value_or("?").c_str());

  const std::uint64_t wanted = std::strtoull(argv[2], nullptr, 10);
  Frames again;
  if (!load_index(decoder, file)) return std::fprintf(stderr, "there is no index\n"), 1;
  const std::optional<std::uint64_t> offset = decoder.seek(wanted);
  if (!offset) return std::fprintf(stderr, "%s\n", decoder.error_text().c_str()), 1;
  if (!decode(decoder, file, *offset, 1, again) || again.empty()) return 1;
  std::printf("frame %llu again: %s\n", static_cast<unsigned long long>(wanted),
              again[0] == all[wanted] ? "the same" : "different");
  return again[0] == all[wanted] ? 0 : 1;
}
