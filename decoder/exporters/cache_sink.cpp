#include "decoder/exporters/cache_sink.hpp"

#include "decoder/exporters/bytes.hpp"
#include "decoder/exporters/material_files.hpp"
#include "decoder/exporters/mesh_writers.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

constexpr std::uint64_t kTimesBlock = 4096;
/// An array's header in NumPy's format 1.0, with room for any numbers: so many bytes, whatever it says.
constexpr std::size_t kNpyHeader = 128;
constexpr std::uint64_t kMaximumCount = std::numeric_limits<std::int32_t>::max();

template <class T>
void append32(std::string& bytes, T value, bool big_endian) {
  bytes.resize(bytes.size() + 4);
  store32(bytes.data() + bytes.size() - 4, value, big_endian);
}

}  // namespace

std::string mesh_beside(const std::string& cache) {
  return std::filesystem::path(cache).replace_extension(".obj").string();
}

std::string materials_beside(const std::string& mesh) {
  return std::filesystem::path(mesh).replace_extension(".mtl").string();
}

CacheSink::CacheSink(const std::string& path, CacheFormat format, const SinkOptions& options)
    : file_(path), format_(format) {
  if (options.mesh_beside_cache && path != "-") {
    mesh_path_ = mesh_beside(path);
    refuse_foreign_file(mesh_path_, "the mesh of " + path);
    materials_ = std::make_unique<MaterialFiles>(materials_beside(mesh_path_));
  }
}

CacheSink::~CacheSink() = default;

std::string CacheSink::format_name() const {
  switch (format_) {
    case CacheFormat::kPc2:
      return "PC2";
    case CacheFormat::kMdd:
      return "MDD";
    case CacheFormat::kNpy:
      return "NPY";
  }
  return "";
}

void CacheSink::add_data(const NamedData& data) {
  times_.add_data(data);
  if (materials_) materials_->add_data(data);
  if (data.name == "skeleton") losses_.add("the skeleton");
}

void CacheSink::begin_mesh(const Mesh& mesh, const MeshProperties& properties, const Metadata& metadata,
                           std::optional<std::uint64_t> frame_count) {
  if (begun_) {
    throw ToolError(
        ExitStatus::kUsage,
        fmt::format("{}: the mesh changes at frame {}, and a {} cache holds one mesh: write a "
                    "sequence of files (such as back_%04d.ply), or a part of the frames (--frames)",
                    file_.path(), frames_, format_name()));
  }
  if (!frame_count && !file_.seekable()) {
    throw ToolError(
        ExitStatus::kUsage,
        fmt::format("a {} cache begins with its number of frames, which this input does not tell in "
                    "advance: write it to a file instead of a pipe, or read the input from a file",
                    format_name()));
  }
  if (mesh.vertex_count > kMaximumCount || frame_count.value_or(0) > kMaximumCount) {
    throw ToolError(ExitStatus::kUsage, fmt::format("{}: a {} cache cannot hold so many vertices or frames",
                                                    file_.path(), format_name()));
  }
  begun_ = true;
  mesh_ = mesh;
  properties_ = properties;
  if (!mesh_path_.empty()) losses_.add(HeldBy::kObj, mesh, properties);
  if (const auto name = metadata.find("name"); name != metadata.end()) name_ = name->second;
  times_.set_rate(metadata, 1);
  origin_ = origin_of(metadata).value_or(Origin{});
  promised_ = frame_count.value_or(0);
  write_header();
}

std::string CacheSink::fixed_header(std::uint64_t frames) const {
  std::string bytes;
  const auto count = static_cast<std::uint32_t>(frames);
  switch (format_) {
    case CacheFormat::kPc2:
      bytes.append("POINTCACHE2", 12);
      append32(bytes, std::uint32_t{1}, false);  // version
      append32(bytes, mesh_.vertex_count, false);
      append32(bytes, 0.0F, false);  // first frame
      append32(bytes, 1.0F, false);  // frames per sample
      append32(bytes, count, false);
      break;
    case CacheFormat::kMdd:
      append32(bytes, count, true);
      append32(bytes, mesh_.vertex_count, true);
      break;
    case CacheFormat::kNpy:
      bytes.append("\x93NUMPY\x01\0", 8);
      bytes += static_cast<char>(kNpyHeader - 10);
      bytes += '\0';
      bytes += fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}, 3), }}", frames,
                           mesh_.vertex_count);
      bytes.resize(kNpyHeader - 1, ' ');
      bytes += '\n';
      break;
  }
  return bytes;
}

std::uint64_t CacheSink::header_size(std::uint64_t frames) const {
  return format_ == CacheFormat::kMdd ? 8 + 4 * frames : fixed_header(frames).size();
}

std::string CacheSink::mdd_times(std::uint64_t first, std::uint64_t end) const {
  std::string bytes;
  for (std::uint64_t frame = first; frame < end; ++frame) {
    append32(bytes, static_cast<float>(times_.of(frame)), true);
  }
  return bytes;
}

void CacheSink::write_header() {
  file_.write(fixed_header(promised_));
  if (format_ != CacheFormat::kMdd) return;
  times_written_ = times_.are_uneven();
  for (std::uint64_t frame = 0; frame < promised_; frame += kTimesBlock) {
    file_.write(mdd_times(frame, std::min(frame + kTimesBlock, promised_)));
  }
}

void CacheSink::correct_header() {
  const std::string fixed = fixed_header(frames_);
  if (format_ == CacheFormat::kMdd) {
    // The header has a time per frame, so its size changes with their number.
    if (promised_ != frames_) file_.move_tail(header_size(promised_), header_size(frames_));
    const bool all = times_.are_uneven() && !times_written_;
    for (std::uint64_t frame = all ? 0 : promised_; frame < frames_; frame += kTimesBlock) {
      const std::string times = mdd_times(frame, std::min(frame + kTimesBlock, frames_));
      file_.overwrite(header_size(frame), times.data(), times.size());
    }
  }
  file_.overwrite(0, fixed.data(), fixed.size());
}

void CacheSink::write_frame(std::span<const float> positions, AnimatedValues animated) {
  if (frames_ == kMaximumCount) {
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("{}: a {} cache cannot hold more frames", file_.path(), format_name()));
  }
  if (frames_ == 0 && !mesh_path_.empty()) write_mesh_beside(positions, animated);
  bytes_.resize(positions.size_bytes());
  const bool big_endian = format_ == CacheFormat::kMdd;
  for (std::size_t i = 0; i < positions.size(); ++i) store32(bytes_.data() + 4 * i, positions[i], big_endian);
  file_.write(bytes_.data(), bytes_.size());
  ++frames_;
}

void CacheSink::write_mesh_beside(std::span<const float> positions, AnimatedValues animated) {
  mesh_file_.emplace(mesh_path_);
  write_obj(*mesh_file_, {mesh_, properties_, positions, animated, name_, Origin{}, materials_->library()});
}

std::vector<std::string> CacheSink::notes() const {
  std::vector<std::string> notes;
  if (!is_zero(origin_)) notes.push_back(relative_note(origin_, format_name()));
  if (!properties_.empty()) {
    notes.push_back(mesh_path_.empty()
                        ? format_name() + " has positions alone: attributes and parts are left out"
                        : fmt::format("{} has positions alone: attributes and parts are in {}", format_name(),
                                      mesh_path_));
  }
  const bool changes = std::any_of(properties_.attributes.begin(), properties_.attributes.end(),
                                   [](const Attribute& attribute) { return attribute.animated; });
  if (changes && !mesh_path_.empty())
    notes.push_back(
        fmt::format("attributes change over time, and {} has those of the first frame", mesh_path_));
  if (times_.are_uneven() && format_ != CacheFormat::kMdd)
    notes.push_back(fmt::format("{} has no place for the frames' uneven times: MDD has", format_name()));
  for (const std::string& note : losses_.notes(mesh_path_.empty() ? format_name() : "OBJ"))
    notes.push_back(note);
  if (materials_) {
    for (const std::string& note : materials_->notes()) notes.push_back(note);
  }
  return notes;
}

void CacheSink::finish() {
  if (frames_ == 0) throw ToolError(ExitStatus::kInvalidInput, "there are no frames to write");
  const bool times_came_late =
      format_ == CacheFormat::kMdd && times_.are_uneven() && !times_written_ && file_.seekable();
  if (frames_ != promised_ || times_came_late) {
    if (!file_.seekable()) {
      throw ToolError(
          ExitStatus::kOther,
          fmt::format("{}: {} frames were announced in the header, but {} were decoded",
                      file_.path() == "-" ? "standard output" : file_.path(), promised_, frames_));
    }
    correct_header();
  }
  if (mesh_file_) {
    materials_->finish(files_beside_);
    mesh_file_->finish();
    files_.push_back(mesh_path_);
  }
  file_.finish();
  files_.push_back(file_.path());
}

}  // namespace tvg::cli
