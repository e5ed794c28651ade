#include "encoder/importers/import_error.hpp"
#include "encoder/importers/materials.hpp"
#include "encoder/importers/mesh_sequence.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>

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
    read_mesh(files_[file], ahead_);
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

/// Materials of the first file with a mesh and of all that come after it.
void MeshSequenceSource::read_materials_of(const std::string& file) {
  if (known_ != nullptr || !data_.empty() || !options_.properties.wanted) return;
  const std::size_t next = std::min(stretch_ + 1, files_.size());
  SequenceMaterials materials = read_sequence_materials(file, current_, std::span(files_).subspan(next),
                                                        options_.properties.embed_textures, notes_);
  data_ = std::move(materials.data);
  renamed_materials_ = std::move(materials.renamed);
}

/// Reads a file, its materials called as the sequence calls them.
void MeshSequenceSource::read_mesh(const std::string& file, MeshFile& mesh) {
  read_located_mesh(file, format_, buffer_, mesh);
  const auto renamed = renamed_materials_.find(file);
  if (renamed == renamed_materials_.end()) return;
  for (Part& part : mesh.parts) {
    if (const auto name = renamed->second.find(part.material); name != renamed->second.end())
      part.material = name->second;
  }
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
