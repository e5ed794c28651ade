#include "encoder/importers/mesh_sequence.hpp"

#include "encoder/importers/import_error.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace tvg::cli {

WeldedMesh read_welded_mesh(const std::string& path) {
  WeldedMesh welded;
  welded.format = mesh_format(path).value();
  std::string buffer;
  read_mesh_file(path, welded.format, buffer, welded.mesh);
  if (welded.mesh.polygons > 0) {
    welded.notes.push_back(fmt::format("{}: {} polygons triangulated to {} triangles", path,
                                       welded.mesh.polygons, welded.mesh.polygon_triangles));
  }
  if (welded.format == MeshFormat::kStl) {
    welded.weld = weld_positions(welded.mesh.positions);
    static_cast<void>(apply_weld(welded.weld, welded.mesh));
    welded.notes.push_back(fmt::format("{}: {} corners welded to {} vertices", path,
                                       welded.weld.vertex_of_point.size(), welded.weld.vertex_count()));
  }
  return welded;
}

MeshSequenceSource::MeshSequenceSource(std::vector<std::string> files, WeldedMesh first,
                                       std::uint64_t first_frame)
    : files_(std::move(files)), first_(std::move(first)), first_frame_(first_frame) {
  mesh_.vertex_count = static_cast<std::uint32_t>(first_.mesh.vertex_count());
  mesh_.faces = std::move(first_.mesh.faces);
}

Metadata MeshSequenceSource::metadata() const {
  Metadata metadata;
  if (!first_.mesh.name.empty()) metadata.emplace("name", first_.mesh.name);
  return metadata;
}

Result<bool> MeshSequenceSource::read_frame(std::span<float> positions) {
  if (next_ == files_.size()) return false;
  if (next_ == 0) {
    std::copy(first_.mesh.positions.begin(), first_.mesh.positions.end(), positions.begin());
  } else {
    try {
      read_positions(files_[next_], positions);
    } catch (const ImportError& error) {
      return error.as_value();
    }
  }
  ++next_;
  return true;
}

void MeshSequenceSource::read_positions(const std::string& path, std::span<float> positions) {
  read_mesh_file(path, first_.format, buffer_, current_);
  if (first_.format == MeshFormat::kStl) weld_frame(path);
  if (current_.vertex_count() != mesh_.vertex_count) {
    fail_changed(path, fmt::format("has {} vertices where {} has {}", current_.vertex_count(), files_[0],
                                   mesh_.vertex_count));
  }
  if (current_.faces.size() != mesh_.faces.size()) {
    fail_changed(path, fmt::format("has {} triangles where {} has {}", current_.faces.size(), files_[0],
                                   mesh_.faces.size()));
  }
  const auto [ours, theirs] =
      std::mismatch(current_.faces.begin(), current_.faces.end(), mesh_.faces.begin());
  if (ours != current_.faces.end()) {
    fail_changed(path, fmt::format("has the vertices {} {} {} in triangle {} where {} has {} {} {}",
                                   (*ours)[0], (*ours)[1], (*ours)[2], ours - current_.faces.begin(),
                                   files_[0], (*theirs)[0], (*theirs)[1], (*theirs)[2]));
  }
  std::copy(current_.positions.begin(), current_.positions.end(), positions.begin());
}

void MeshSequenceSource::weld_frame(const std::string& path) {
  const std::size_t corners = first_.weld.vertex_of_point.size();
  if (current_.vertex_count() != corners) {
    fail_changed(
        path, fmt::format("has {} triangles where {} has {}", current_.faces.size(), files_[0], corners / 3));
  }
  const std::optional<std::size_t> torn = apply_weld(first_.weld, current_);
  if (torn) {
    fail_changed(path,
                 fmt::format("tears corner {} of triangle {} off the corners that share its vertex in {}",
                             *torn % 3, *torn / 3, files_[0]));
  }
}

void MeshSequenceSource::fail_changed(const std::string& path, const std::string& difference) const {
  const std::uint64_t frame = first_frame_ + next_;
  throw ImportError(
      ErrorCode::kInvalidInput,
      fmt::format("{} (frame {}) {}. One mesh holds for a whole sequence: encode the frames {}-{} and "
                  "those from {} on separately (--frames) and join the streams with `tvg join`",
                  path, frame, difference, first_frame_, frame - 1, frame));
}

Status MeshSequenceSource::skip_frames(std::uint64_t count) {
  next_ += count;
  return {};
}

bool MeshSequenceSource::rewind() {
  next_ = 0;
  return true;
}

}  // namespace tvg::cli
