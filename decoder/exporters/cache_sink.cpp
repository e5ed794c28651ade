#include "decoder/exporters/cache_sink.hpp"

#include "decoder/exporters/bytes.hpp"
#include "decoder/exporters/mesh_writers.hpp"
#include "tool/option_values.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <string_view>

namespace tvg::cli {

namespace {

constexpr std::uint64_t kTimesBlock = 4096;
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

CacheSink::CacheSink(const std::string& path, CacheFormat format, const SinkOptions& options)
    : file_(path), format_(format) {
  if (options.mesh_beside_cache && path != "-") {
    mesh_path_ = mesh_beside(path);
    check_mesh_beside();
  }
}

void CacheSink::check_mesh_beside() const {
  std::ifstream existing(mesh_path_, std::ios::binary);
  if (!existing) return;
  std::string mark(std::string_view(kObjMark).size(), '\0');
  existing.read(mark.data(), static_cast<std::streamsize>(mark.size()));
  if (mark == kObjMark) return;
  throw ToolError(
      ExitStatus::kUsage,
      fmt::format("{} would get the mesh of {}, but it exists and another program wrote it: give another "
                  "name for the output, or ask for the cache without its mesh",
                  mesh_path_, file_.path()));
}

void CacheSink::begin_mesh(const Mesh& mesh, const Metadata& metadata,
                           std::optional<std::uint64_t> frame_count) {
  if (begun_) {
    throw ToolError(
        ExitStatus::kUsage,
        fmt::format("{}: the connectivity changes at frame {}, and a {} cache holds one mesh: write a "
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
  if (const auto name = metadata.find("name"); name != metadata.end()) name_ = name->second;
  if (const auto fps = metadata.find("fps"); fps != metadata.end()) {
    seconds_per_frame_ = 1 / parse_frame_rate(fps->second).value_or(1);
  }
  origin_ = origin_of(metadata).value_or(Origin{});
  promised_ = frame_count.value_or(0);
  write_header();
}

std::string CacheSink::fixed_header(std::uint64_t frames) const {
  std::string bytes;
  const auto count = static_cast<std::uint32_t>(frames);
  if (format_ == CacheFormat::kPc2) {
    bytes.append("POINTCACHE2", 12);
    append32(bytes, std::uint32_t{1}, false);  // version
    append32(bytes, mesh_.vertex_count, false);
    append32(bytes, 0.0F, false);  // first frame
    append32(bytes, 1.0F, false);  // frames per sample
    append32(bytes, count, false);
  } else {
    append32(bytes, count, true);
    append32(bytes, mesh_.vertex_count, true);
  }
  return bytes;
}

std::uint64_t CacheSink::header_size(std::uint64_t frames) const {
  return format_ == CacheFormat::kPc2 ? 32 : 8 + 4 * frames;
}

std::string CacheSink::mdd_times(std::uint64_t first, std::uint64_t end) const {
  std::string bytes;
  for (std::uint64_t frame = first; frame < end; ++frame) {
    append32(bytes, static_cast<float>(static_cast<double>(frame) * seconds_per_frame_), true);
  }
  return bytes;
}

void CacheSink::write_header() {
  file_.write(fixed_header(promised_));
  if (format_ == CacheFormat::kPc2) return;
  for (std::uint64_t frame = 0; frame < promised_; frame += kTimesBlock) {
    file_.write(mdd_times(frame, std::min(frame + kTimesBlock, promised_)));
  }
}

void CacheSink::correct_header() {
  const std::string fixed = fixed_header(frames_);
  // An MDD header has a time per frame, so its size changes with their number.
  if (header_size(promised_) != header_size(frames_)) {
    file_.move_tail(header_size(promised_), header_size(frames_));
    for (std::uint64_t frame = promised_; frame < frames_; frame += kTimesBlock) {
      const std::string times = mdd_times(frame, std::min(frame + kTimesBlock, frames_));
      file_.overwrite(header_size(frame), times.data(), times.size());
    }
  }
  file_.overwrite(0, fixed.data(), fixed.size());
}

void CacheSink::write_frame(std::span<const float> positions) {
  if (frames_ == kMaximumCount) {
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("{}: a {} cache cannot hold more frames", file_.path(), format_name()));
  }
  if (frames_ == 0 && !mesh_path_.empty()) write_mesh_beside(positions);
  bytes_.resize(positions.size_bytes());
  const bool big_endian = format_ == CacheFormat::kMdd;
  for (std::size_t i = 0; i < positions.size(); ++i) store32(bytes_.data() + 4 * i, positions[i], big_endian);
  file_.write(bytes_.data(), bytes_.size());
  ++frames_;
}

void CacheSink::write_mesh_beside(std::span<const float> positions) {
  mesh_file_.emplace(mesh_path_);
  write_mesh(*mesh_file_, MeshFormat::kObj, mesh_, positions, name_);
}

std::vector<std::string> CacheSink::notes() const {
  if (is_zero(origin_)) return {};
  return {relative_note(origin_, format_name())};
}

void CacheSink::finish() {
  if (frames_ == 0) throw ToolError(ExitStatus::kInvalidInput, "there are no frames to write");
  if (frames_ != promised_) {
    if (!file_.seekable()) {
      throw ToolError(
          ExitStatus::kOther,
          fmt::format("{}: {} frames were announced in the header, but {} were decoded",
                      file_.path() == "-" ? "standard output" : file_.path(), promised_, frames_));
    }
    correct_header();
  }
  if (mesh_file_) {
    mesh_file_->finish();
    files_.push_back(mesh_path_);
  }
  file_.finish();
  files_.push_back(file_.path());
}

}  // namespace tvg::cli
