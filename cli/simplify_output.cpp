#include "cli/simplify_output.hpp"

#include "decoder/exporters/frame_sink.hpp"
#include "tool/option_values.hpp"
#include "tool/progress.hpp"
#include "tool/stream_source.hpp"
#include "tool/tool_error.hpp"

#include <fmt/format.h>

namespace tvg::cli {

namespace {

std::string words_of(const FrameSink& sink, const std::string& path, std::uint64_t frames) {
  std::string words;
  for (const std::string& note : sink.notes()) words += "note: " + note + "\n";
  const std::vector<std::string>& files = sink.files();
  const std::string names = files.empty()       ? path
                            : files.size() <= 2 ? fmt::format("{}", fmt::join(files, ", "))
                                                : files.front() + " to " + files.back();
  return words + fmt::format("{}: {} frames", names, frames);
}

std::string words_of(const EncodeReport& report, const std::string& path) {
  return fmt::format("{}: {} frames, {}", path, report.frames, readable_bytes(report.bytes));
}

ByteSink sink_of(StreamOutput& output) {
  return [&output](std::span<const std::uint8_t> bytes) {
    output.write(bytes);
    return Status();
  };
}

}  // namespace

std::string write_frames(FrameSource& source, const std::string& path, const EncodeOptions& options,
                         ProgressBar& bar) {
  if (is_stream_file(path)) {
    const std::unique_ptr<StreamOutput> output = open_stream_output(path, false);
    const Result<EncodeReport> report = encode(
        source, options, sink_of(*output),
        [&bar](std::uint64_t frames, std::optional<std::uint64_t> total) { bar.update(frames, total); });
    if (!report) throw tool_error(path, report.error());
    output->finish();
    return words_of(*report, path);
  }
  const std::unique_ptr<FrameSink> sink = open_sink(path, {true, options.first_frame});
  sink->begin_mesh(source.mesh(), source.metadata(), source.frame_count());
  FramePositions frame(3 * std::size_t{source.mesh().vertex_count});
  std::uint64_t frames = 0;
  for (;; ++frames) {
    const Result<bool> more = source.read_frame(frame);
    if (!more) throw tool_error(path, more.error());
    if (!*more) break;
    sink->write_frame(frame);
    bar.update(frames + 1, source.frame_count());
  }
  sink->finish();
  return words_of(*sink, path, frames);
}

ChangingMeshOutput::ChangingMeshOutput(std::string path, const EncodeOptions& options,
                                       std::uint64_t frame_count)
    : path_(std::move(path)), metadata_(options.metadata), frame_count_(frame_count) {
  if (!is_stream_file(path_)) {
    sink_ = open_sink(path_, {true, options.first_frame});
    return;
  }
  stream_ = open_stream_output(path_, false);
  encoder_.emplace(options, sink_of(*stream_));
}

ChangingMeshOutput::~ChangingMeshOutput() = default;

void ChangingMeshOutput::write(const Mesh& mesh, std::span<const float> positions) {
  if (sink_) {
    sink_->begin_mesh(mesh, metadata_, frame_count_);
    sink_->write_frame(positions);
    return;
  }
  Status status = encoder_->set_mesh(mesh);
  if (status.ok()) status = encoder_->add_frame(positions);
  if (!status.ok()) throw tool_error(path_, status.error());
}

std::string ChangingMeshOutput::finish() {
  if (sink_) {
    sink_->finish();
    return words_of(*sink_, path_, frame_count_);
  }
  const Result<EncodeReport> report = encoder_->finish();
  if (!report) throw tool_error(path_, report.error());
  stream_->finish();
  return words_of(*report, path_);
}

}  // namespace tvg::cli
