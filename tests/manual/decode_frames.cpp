// Reads a stream from standard input and prints the first vertex of every frame.
#include <cstdint>
#include <cstdio>
#include <vector>

#include <tvg/decoder.hpp>

int main() {
  using Event = tvg::Decoder::Event;
  tvg::Decoder decoder;
  std::vector<std::uint8_t> piece(1 << 16);
  std::vector<float> positions;  // [vertex][xyz]
  for (;;) {
    switch (decoder.poll()) {
      case Event::kNeedBytes: {
        const std::size_t count = std::fread(piece.data(), 1, piece.size(), stdin);
        count > 0 ? decoder.push({piece.data(), count}) : decoder.finish();
        break;
      }
      case Event::kMesh:  // the faces are in decoder.mesh().faces
        positions.resize(3 * std::size_t{decoder.mesh().vertex_count});
        break;
      case Event::kFrame:
        decoder.copy_positions(positions.data());
        std::printf("%g %g %g\n", positions[0], positions[1], positions[2]);
        break;
      case Event::kDamage:  // some frames are lost, decoding goes on
        std::fprintf(stderr, "%s\n", decoder.damage().error.describe().c_str());
        break;
      case Event::kError:
        std::fprintf(stderr, "%s\n", decoder.error().describe().c_str());
        return 1;
      case Event::kEnd:
        return 0;
      default:
        break;
    }
  }
}
