#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>

#include <tvg/encoder.hpp>

namespace tvg::cli {

class FrameSink;
class ProgressBar;
class StreamOutput;

/// Where simplified frames go: a .tvg, or any format that decoding writes. Failures are ToolErrors that name
/// the file; no file appears under its name before it is complete.
class SimplifyOutput {
 public:
  /// Opens it, so that a name that will not do is known before the work is done. `first_number`: that of the
  /// first frame.
  SimplifyOutput(std::string path, std::uint64_t first_number);
  ~SimplifyOutput();

  /// Writes all frames of a source. `options`: of a .tvg. Says in a few words what was written.
  std::string write(FrameSource& source, const EncodeOptions& options, ProgressBar& bar);

  /// Instead: frames that each bring a mesh of their own. `options`: of a .tvg, with the box of all frames
  /// and bounds for all meshes; their metadata go with the frames whatever the format.
  void begin(const EncodeOptions& options, std::uint64_t frame_count);
  /// `positions`: [vertex][xyz].
  void add(const Mesh& mesh, std::span<const float> positions);
  /// Completes the output and says in a few words what was written.
  std::string finish();

 private:
  std::string words(std::uint64_t frames) const;
  std::string finish(const Result<EncodeReport>& report);
  ByteSink bytes() const;

  std::string path_;
  std::unique_ptr<FrameSink> sink_;       // of what is no .tvg
  std::unique_ptr<StreamOutput> stream_;  // of a .tvg
  std::optional<Encoder> encoder_;
  Metadata metadata_;
  std::uint64_t frame_count_ = 0;
};

}  // namespace tvg::cli
