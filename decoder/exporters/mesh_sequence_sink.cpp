#include "decoder/exporters/mesh_sequence_sink.hpp"

#include "decoder/exporters/mesh_writers.hpp"
#include "tool/tool_error.hpp"

#include <filesystem>

namespace tvg::cli {

namespace {

constexpr std::size_t kDefaultWidth = 4;

/// What numbered_name() stands for, taken apart; a "%" in the name is no part of the pattern.
FramePattern pattern_for(const std::string& path) {
  const std::filesystem::path name(path);
  const std::string file_name = name.filename().string();
  return {path.substr(0, path.size() - file_name.size()), name.stem().string() + "_",
          name.extension().string(), kDefaultWidth};
}

}  // namespace

std::string numbered_name(const std::string& path) {
  const FramePattern pattern = pattern_for(path);
  return pattern.folder + pattern.prefix + "%0" + std::to_string(pattern.width) + "d" + pattern.suffix;
}

MeshSequenceSink::MeshSequenceSink(const std::string& path, MeshFormat format, const SinkOptions& options)
    : format_(format), options_(options) {
  if (const auto pattern = parse_frame_pattern(path)) {
    pattern_ = *pattern;
  } else {
    plain_name_ = path;
    pattern_ = pattern_for(path);
  }
}

void MeshSequenceSink::begin_mesh(const Mesh& mesh, const Metadata& metadata,
                                  std::optional<std::uint64_t> frame_count) {
  if (frame_count.value_or(1) > 1) plain_name_.clear();
  mesh_ = mesh;
  const auto name = metadata.find("name");
  object_name_ = name == metadata.end() ? "" : name->second;
  origin_ = origin_of(metadata).value_or(Origin{});
}

void MeshSequenceSink::write_frame(std::span<const float> positions) {
  if (last_) finish_file(pattern_.path(options_.first_number + files_.size()));
  // Where the number of frames is unknown, the second one shows that the plain name will not do.
  const bool is_first = files_.empty() && !plain_name_.empty();
  last_ = std::make_unique<AtomicFile>(is_first ? plain_name_
                                                : pattern_.path(options_.first_number + files_.size()));
  write_mesh(*last_, format_, mesh_, positions, object_name_, origin_);
}

void MeshSequenceSink::finish() {
  if (!last_) throw ToolError(ExitStatus::kInvalidInput, "there are no frames to write");
  const bool is_only = files_.empty() && !plain_name_.empty();
  finish_file(is_only ? plain_name_ : pattern_.path(options_.first_number + files_.size()));
}

void MeshSequenceSink::finish_file(const std::string& path) {
  if (path == last_->path()) {
    last_->finish();
  } else {
    last_->finish_as(path);
  }
  last_.reset();
  files_.push_back(path);
}

std::vector<std::string> MeshSequenceSink::notes() const {
  if (format_ != MeshFormat::kStl) return {};
  std::vector<std::string> notes = {
      "STL holds corners of triangles only: the order of vertices, and vertices without a face, are lost"};
  if (!is_zero(origin_)) notes.push_back(relative_note(origin_, "STL"));
  return notes;
}

}  // namespace tvg::cli
