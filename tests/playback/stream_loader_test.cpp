#include "player/playback/stream_loader.hpp"

#include "playback_toolbox.hpp"

namespace tvg::test {
namespace {

TEST(StreamLoader, EveryFrameOfAFileIsThatOfAPlainDecoder) {
  const Stream stream = encoded("toy", 5);
  const DecodedStream plain = decode_stream(stream);
  const TemporaryFile file(stream);
  cli::StreamLoader loader(cli::open_stream_input(file.path()));
  ASSERT_EQ(plain.frames.size(), 12u);
  for (const DecodedFrame& frame : plain.frames) expect_frame(loader, frame);
}

}  // namespace
}  // namespace tvg::test
