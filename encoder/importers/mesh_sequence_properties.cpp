#include "encoder/importers/import_error.hpp"
#include "encoder/importers/materials.hpp"
#include "encoder/importers/mesh_sequence.hpp"

#include <fmt/format.h>

// What a sequence of mesh files has beside positions.
namespace tvg::cli {

/// Finds out what of the mesh's properties changes from file to file.
void MeshSequenceSource::look_ahead() {
  const std::size_t last = files_.size() - 1;
  if (known_->properties.vary() && last > stretch_ && look_at_file(stretch_ + 1)) {
    const std::size_t middle = stretch_ + (last - stretch_) / 2;
    if (middle > stretch_ + 1) look_at_file(middle);
    if (last > stretch_ + 1) look_at_file(last);
  }
  std::vector<std::string> notes;
  known_->properties.settle(known_->mesh.faces, false, notes);
  tell(known_->file, notes);
}

/// Whether a file has the mesh of this stretch; then what it has beside is looked at.
bool MeshSequenceSource::look_at_file(std::size_t file) {
  if (files_[file] == known_->file) return true;
  loaded_ahead_.reset();
  ahead_.origin = options_.origin;
  ahead_.positions_only = false;
  try {
    read_located_mesh(files_[file], format_, buffer_, ahead_);
  } catch (const ImportError&) {
    return false;  // told when the frame is read
  }
  loaded_ahead_ = file;
  if (ahead_.vertex_count() != known_->mesh.vertex_count ||
      !known_->order.difference(ahead_, known_->file).empty())
    return false;
  known_->properties.look_at(ahead_, known_->mesh.faces);
  return true;
}

/// The materials of the first file with a mesh are those of the sequence.
void MeshSequenceSource::read_materials_of(const std::string& file) {
  if (known_ != nullptr || !data_.empty() || !options_.properties.wanted) return;
  data_ = read_materials(file, current_, options_.properties.embed_textures, notes_);
}

/// Notes on the first mesh are told at once, on others later.
void MeshSequenceSource::tell(const std::string& file, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    if (seen_.empty()) {
      notes_.push_back(fmt::format("{}: {}", file, note));
    } else {
      later_->add(file, note);
    }
  }
}

void MeshSequenceSource::read_values(const std::string& path) {
  std::string note;
  const std::string other = known_->properties.read(current_, known_->mesh.faces, note);
  if (!other.empty()) fail_changed(path, fmt::format("has other {} than {}", other, known_->file));
  if (!note.empty()) later_->add(path, note);
}

}  // namespace tvg::cli
