#include "decoder/exporters/mesh_sequence_sink.hpp"

#include "decoder/exporters/material_files.hpp"
#include "decoder/exporters/mesh_writers.hpp"
#include "tool/tool_error.hpp"

#include <array>
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

HeldBy held_by(MeshFormat format) {
  switch (format) {
    case MeshFormat::kObj:
      return HeldBy::kObj;
    case MeshFormat::kPly:
      return HeldBy::kPly;
    case MeshFormat::kOff:
      return HeldBy::kOff;
    case MeshFormat::kStl:
      return HeldBy::kStl;
  }
  return HeldBy::kStl;
}

const char* name_of(MeshFormat format) {
  constexpr std::array<const char*, 4> kNames = {"OBJ", "PLY", "OFF", "STL"};
  return kNames[static_cast<std::size_t>(format)];
}

}  // namespace

std::string materials_of_sequence(const std::string& path) {
  const auto pattern = parse_frame_pattern(path);
  if (!pattern) return std::filesystem::path(path).replace_extension(".mtl").string();
  std::string stem = pattern->prefix.substr(0, pattern->prefix.find_last_not_of("_-. ") + 1);
  if (stem.empty()) stem = "materials";
  return pattern->folder + stem + ".mtl";
}

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
  if (format == MeshFormat::kObj) materials_ = std::make_unique<MaterialFiles>(materials_of_sequence(path));
}

MeshSequenceSink::~MeshSequenceSink() = default;

void MeshSequenceSink::add_data(const NamedData& data) {
  if (materials_) materials_->add_data(data);
  if (data.name == "skeleton") losses_.add("the skeleton");
  if (data.name == "times") losses_.add("the frames' uneven times");
}

void MeshSequenceSink::begin_mesh(const Mesh& mesh, const MeshProperties& properties,
                                  const Metadata& metadata, std::optional<std::uint64_t> frame_count) {
  if (frame_count.value_or(1) > 1) plain_name_.clear();
  // One vertex and no faces stand for a frame that shows nothing.
  shows_nothing_ = mesh.vertex_count == 1 && mesh.faces.empty();
  mesh_ = shows_nothing_ ? Mesh() : mesh;
  properties_ = shows_nothing_ ? MeshProperties() : properties;
  losses_.add(held_by(format_), mesh_, properties_);
  const auto name = metadata.find("name");
  object_name_ = name == metadata.end() ? "" : name->second;
  origin_ = origin_of(metadata).value_or(Origin{});
}

void MeshSequenceSink::write_frame(std::span<const float> positions, AnimatedValues animated) {
  if (last_) finish_file(pattern_.path(options_.first_number + frames_));
  // Where the number of frames is unknown, the second one shows that the plain name will not do.
  const bool is_first = frames_ == 0 && !plain_name_.empty();
  last_ =
      std::make_unique<AtomicFile>(is_first ? plain_name_ : pattern_.path(options_.first_number + frames_));
  write_mesh(*last_, format_,
             {mesh_, properties_, shows_nothing_ ? std::span<const float>() : positions, animated,
              object_name_, origin_, materials_ ? materials_->library() : std::string()});
}

void MeshSequenceSink::finish() {
  if (!last_) throw ToolError(ExitStatus::kInvalidInput, "there are no frames to write");
  const bool is_only = frames_ == 0 && !plain_name_.empty();
  finish_file(is_only ? plain_name_ : pattern_.path(options_.first_number + frames_));
  if (materials_) materials_->finish(files_beside_);
}

void MeshSequenceSink::finish_file(const std::string& path) {
  if (path == last_->path()) {
    last_->finish();
  } else {
    last_->finish_as(path);
  }
  last_.reset();
  ++frames_;
  files_.push_back(path);
}

std::vector<std::string> MeshSequenceSink::notes() const {
  std::vector<std::string> notes;
  if (format_ == MeshFormat::kStl) {
    notes.emplace_back(
        "STL holds corners of triangles only: the order of vertices, and vertices without a face, are lost");
    if (!is_zero(origin_)) notes.push_back(relative_note(origin_, "STL"));
  }
  for (const std::string& note : losses_.notes(name_of(format_))) notes.push_back(note);
  if (materials_) {
    for (const std::string& note : materials_->notes()) notes.push_back(note);
  }
  return notes;
}

}  // namespace tvg::cli
