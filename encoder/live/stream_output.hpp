#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace tvg::cli {

/// Where a stream goes. Failures are ToolErrors (kIo) that name the file or the URL.
class StreamOutput {
 public:
  virtual ~StreamOutput() = default;

  /// Appends.
  virtual void write(std::span<const std::uint8_t> bytes) = 0;
  /// The stream is complete. Without this call a file does not appear and an upload breaks off.
  virtual void finish() = 0;
};

/// Opens a file, "-" for standard output, or an http or https URL to upload to by PUT. `live`: what is
/// written leaves at once. Uploads do so anyway.
std::unique_ptr<StreamOutput> open_stream_output(const std::string& target, bool live);

}  // namespace tvg::cli
