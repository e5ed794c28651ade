// Writes a stream of one triangle that rises to standard output.
#include <cstdio>
#include <vector>

#include <tvg/encoder.hpp>

int main() {
  tvg::EncodeOptions options;
  options.fine_bits = options.coarse_bits = 12;
  options.metadata["fps"] = "30";
  tvg::Encoder encoder(options, [](std::span<const std::uint8_t> bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size()) return tvg::Status();
    return tvg::Status(tvg::Error{tvg::ErrorCode::kIo, "standard output is full"});
  });
  tvg::Status status = encoder.set_mesh({3, {{0, 1, 2}}});
  for (int frame = 0; frame < 90 && status.ok(); ++frame) {
    const float height = 0.1F * static_cast<float>(frame);
    status = encoder.add_frame(std::vector<float>{0, 0, height, 1, 0, height, 0, 1, height});
  }
  if (status.ok()) {
    if (const tvg::Result<tvg::EncodeReport> report = encoder.finish())
      return 0;
    else
      status = report.error();
  }
  std::fprintf(stderr, "%s\n", status.error().describe().c_str());
  return 1;
}
