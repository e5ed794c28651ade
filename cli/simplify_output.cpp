#include "cli/simplify_output.hpp"

#include "decoder/exporters/frame_sink.hpp"
#include "encoder/live/stream_output.hpp"
#include "tool/option_values.hpp"
#include "tool/progress.hpp"
#include "tool/stream_source.hpp"
#include "tool/tool_error.hpp"

#include <fmt/format.h>

namespace tvg::cli {

SimplifyOutput::SimplifyOutput(std::string path, std::uint64_t first_number) : path_(std::move(path)) {
  if (is_stream_file(path_)) {
    stream_ = open_stream_output(path_, false);
  } else {
    sink_ = open_sink(path_, {true, first_number});
  }
}

SimplifyOutput::~SimplifyOutput() = default;

std::string SimplifyOutput::write(FrameSource& source, const EncodeOptions& options, ProgressBar& bar) {
  if (stream_) {
    return finish(encode(
        source, options, bytes(),
        [&bar](std::uint64_t frames, std::optional<std::uint64_t> total) { bar.update(frames, total); }));
  }
  sink_->begin_mesh(source.mesh(), {}, source.metadata(), source.frame_count());
  FramePositions frame(3 * std::size_t{source.mesh().vertex_count});
  std::uint64_t frames = 0;
  for (;; ++frames) {
    const Result<bool> more = source.read_frame(frame);
    if (!more) throw tool_error(path_, more.error());
    if (!*more) break;
    sink_->write_frame(frame);
    bar.update(frames + 1, source.frame_count());
  }
  sink_->finish();
  return words(frames);
}

void SimplifyOutput::begin(const EncodeOptions& options, std::uint64_t frame_count) {
  metadata_ = options.metadata;
  frame_count_ = frame_count;
  if (stream_) encoder_.emplace(options, bytes());
}

void SimplifyOutput::add(const Mesh& mesh, std::span<const float> positions) {
  if (sink_) {
    sink_->begin_mesh(mesh, {}, metadata_, frame_count_);
    sink_->write_frame(positions);
    return;
  }
  Status status = encoder_->set_mesh(mesh);
  if (status.ok()) status = encoder_->add_frame(positions);
  if (!status.ok()) throw tool_error(path_, status.error());
}

std::string SimplifyOutput::finish() {
  if (stream_) return finish(encoder_->finish());
  sink_->finish();
  return words(frame_count_);
}

std::string SimplifyOutput::finish(const Result<EncodeReport>& report) {
  if (!report) throw tool_error(path_, report.error());
  stream_->finish();
  return fmt::format("{}: {} frames, {}", path_, report->frames, readable_bytes(report->bytes));
}

std::string SimplifyOutput::words(std::uint64_t frames) const {
  std::string text;
  for (const std::string& note : sink_->notes()) text += "note: " + note + "\n";
  return text + fmt::format("{}: {} frames", written_files(*sink_, path_), frames);
}

ByteSink SimplifyOutput::bytes() const {
  return [&output = *stream_](std::span<const std::uint8_t> bytes) {
    output.write(bytes);
    return Status();
  };
}

}  // namespace tvg::cli
