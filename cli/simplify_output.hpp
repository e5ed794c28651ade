#pragma once
#include "encoder/live/stream_output.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string>

#include <tvg/encoder.hpp>

namespace tvg::cli {

class FrameSink;
class ProgressBar;

/// Writes the frames of a source to what `path` names: a .tvg, which is made with `options`, or any format
/// that decoding writes. Says in a few words what was written. Throws ToolError.
std::string write_frames(FrameSource& source, const std::string& path, const EncodeOptions& options,
                         ProgressBar& bar);

/// The same for frames that each bring a mesh of their own.
class ChangingMeshOutput {
 public:
  /// `options`: with the box of all frames and bounds for all meshes.
  ChangingMeshOutput(std::string path, const EncodeOptions& options, std::uint64_t frame_count);
  ~ChangingMeshOutput();

  /// `positions`: [vertex][xyz].
  void write(const Mesh& mesh, std::span<const float> positions);
  /// Completes the output and says in a few words what was written.
  std::string finish();

 private:
  std::string path_;
  Metadata metadata_;
  std::uint64_t frame_count_;
  std::unique_ptr<FrameSink> sink_;
  std::unique_ptr<StreamOutput> stream_;
  std::optional<Encoder> encoder_;
};

}  // namespace tvg::cli
