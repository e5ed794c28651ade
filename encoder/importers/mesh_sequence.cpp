#include "encoder/importers/mesh_sequence.hpp"

#include "encoder/importers/import_error.hpp"
#include "encoder/importers/materials.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace tvg::cli {

namespace {

constexpr std::size_t kMostMeshesKnown = 16;

/// What is to be said of a mesh that was read, each with its file.
std::vector<std::string> notes_on(const std::string& path, const MeshFile& mesh) {
  std::vector<std::string> notes;
  if (!mesh.polygons.empty()) {
    std::uint64_t triangles = 0;
    for (const Polygon& polygon : mesh.polygons) triangles += polygon.corners - 2;
    notes.push_back(
        fmt::format("{}: {} polygons triangulated to {} triangles", path, mesh.polygons.size(), triangles));
  }
  for (const std::string& note : mesh.notes) notes.push_back(fmt::format("{}: {}", path, note));
  return notes;
}

std::string weld_note(const std::string& path, const StlWeld& stl) {
  return fmt::format("{}: {} corners welded to {} vertices", path, stl.weld().vertex_of_point.size(),
                     stl.weld().vertex_count());
}

}  // namespace

WeldedMesh read_welded_mesh(const std::string& path, const SequenceOptions& options) {
  WeldedMesh welded;
  const MeshFormat format = mesh_format(path).value();
  std::string buffer;
  welded.mesh.positions_only = !options.properties.wanted;
  read_mesh_file(path, format, buffer, welded.mesh);
  welded.notes = notes_on(path, welded.mesh);
  if (format == MeshFormat::kStl) {
    const StlWeld stl(welded.mesh.positions, options.weld);
    apply_weld(stl.weld(), welded.mesh);
    welded.notes.push_back(weld_note(path, stl));
  }
  std::vector<std::string> notes;
  if (options.properties.wanted)
    welded.data = read_materials(path, welded.mesh, options.properties.embed_textures, welded.notes);
  welded.properties = StretchProperties(welded.mesh, options.properties);
  welded.properties.settle(welded.mesh.faces, true, notes);
  for (const std::string& note : notes) welded.notes.push_back(fmt::format("{}: {}", path, note));
  return welded;
}

MeshSequenceSource::MeshSequenceSource(std::vector<std::string> files, const SequenceOptions& options,
                                       std::uint64_t first_frame)
    : files_(std::move(files)),
      options_(options),
      first_frame_(first_frame),
      format_(mesh_format(files_[0]).value()) {
  begin_stretch();
}

/// Begins with the mesh of the file that comes next.
void MeshSequenceSource::begin_stretch() {
  last_.clear();
  stretch_ = next_;
  const bool is_first = known_ == nullptr;
  if (!load_next_mesh()) return;
  // What the first file says of the origin holds for all.
  options_.origin = current_.origin.value_or(Origin{});
  const std::string& file = files_[stretch_];
  if (is_first) notes_ = notes_on(file, current_);
  if (format_ == MeshFormat::kStl) {
    std::vector<std::string> notes = look_through_stl(file);
    if (is_first) notes_.insert(notes_.end(), notes.begin(), notes.end());
    apply_weld(stl_.weld(), current_);
    loaded_.reset();
  }
  if (name_.empty()) name_ = current_.name;
  read_materials_of(file);
  know_mesh();
}

/// Goes on to the next file that has a mesh; false where what comes shows nothing.
bool MeshSequenceSource::load_next_mesh() {
  for (;; ++stretch_) {
    next_ = stretch_;
    try {
      load(stretch_);
      return true;
    } catch (const EmptyInputError& empty) {
      const bool is_last = stretch_ + 1 == files_.size();
      if (options_.empty_frames && files_.size() > 1) {
        begin_empty_stretch(empty.what());
        return false;
      }
      if (options_.gaps != Gaps::kSkip || is_last) take_empty_frame(empty.what());
    }
  }
}

/// Whether the mesh that was read is one that was met before, with the same properties.
bool MeshSequenceSource::is_known(KnownMesh& seen) {
  if (seen.shows_nothing || seen.mesh.vertex_count != current_.vertex_count()) return false;
  std::string ignored;
  return seen.order.difference(current_, seen.file).empty() &&
         seen.properties.read(current_, seen.mesh.faces, ignored).empty();
}

/// The mesh that was read is the present one; one that was met before stays as it was.
void MeshSequenceSource::know_mesh() {
  const auto seen =
      std::find_if(seen_.rbegin(), seen_.rend(), [this](const auto& mesh) { return is_known(*mesh); });
  if (seen != seen_.rend()) {
    known_ = *seen;
    return;
  }
  known_ = std::make_shared<KnownMesh>(
      KnownMesh{{static_cast<std::uint32_t>(current_.vertex_count()), current_.faces},
                FaceOrder(current_.faces, current_.polygons),
                files_[stretch_],
                false,
                StretchProperties(current_, options_.properties)});
  look_ahead();
  seen_.push_back(known_);
  if (seen_.size() > kMostMeshesKnown) seen_.pop_front();
}

/// Frames that show nothing have one vertex, where the frame before had its first, so that it lies within
/// the box of the others.
void MeshSequenceSource::begin_empty_stretch(const std::string& what) {
  last_ = place_of_nothing();
  if (last_.empty())
    throw ImportError(ErrorCode::kInvalidInput, what + ", and no other file of the sequence has any");
  known_ = std::make_shared<KnownMesh>(KnownMesh{{1, {}}, FaceOrder(), files_[stretch_], true});
}

/// Empty where no frame shows anything.
std::vector<float> MeshSequenceSource::place_of_nothing() {
  if (place_.empty()) {
    for (std::size_t file = stretch_ + 1; file < files_.size() && place_.empty(); ++file) {
      try {
        load(file);
        if (!options_.origin) options_.origin = current_.origin.value_or(Origin{});
        read_materials_of(files_[file]);
        place_.assign(current_.positions.begin(), current_.positions.begin() + 3);
      } catch (const EmptyInputError&) {
        continue;
      }
    }
  }
  return place_;
}

/// Reads a file, unless it was the last that was read.
bool MeshSequenceSource::load(std::size_t file) {
  // Attributes that were left out of the mesh are not read of its other files, but of one that begins
  // another.
  const bool none_left = known_ != nullptr && known_->properties.all_left_out();
  const bool positions_only = !options_.properties.wanted || (none_left && file != stretch_);
  if (loaded_ == file && current_.positions_only == positions_only) return false;
  loaded_.reset();
  if (loaded_ahead_ == file) {
    std::swap(current_, ahead_);
    loaded_ahead_.reset();
    loaded_ = file;
    return true;
  }
  current_.origin = options_.origin;
  current_.positions_only = positions_only;
  read_mesh(files_[file], current_);
  loaded_ = file;
  return true;
}

/// What of the files that follow belongs to the mesh of the first; notes on that.
std::vector<std::string> MeshSequenceSource::look_through_stl(const std::string& first) {
  stl_ = StlWeld(current_.positions, options_.weld);
  std::string torn_in;
  MeshFile mesh;
  for (std::size_t file = stretch_ + 1; file < files_.size(); ++file) {
    if (files_[file] == files_[file - 1]) continue;
    mesh.origin = options_.origin;
    try {
      read_located_mesh(files_[file], format_, buffer_, mesh);
    } catch (const EmptyInputError&) {
      continue;
    } catch (const ImportError&) {
      break;  // told when the frame is read
    }
    if (!stl_.refine(mesh, first).empty()) break;
    if (torn_in.empty() && stl_.split_vertices() > 0) torn_in = files_[file];
  }
  stl_.rewind();
  std::vector<std::string> notes = {weld_note(first, stl_)};
  if (!torn_in.empty()) {
    notes.push_back(fmt::format(
        "{} of them share a place in {} and come apart later, first in {} (--weld TOLERANCE joins what lies "
        "closer)",
        stl_.split_vertices(), first, torn_in));
  }
  if (stl_.reordered())
    notes.push_back("the triangles stand in another order in some of the files, and were matched");
  return notes;
}

Metadata MeshSequenceSource::metadata() const {
  Metadata metadata;
  if (!name_.empty()) metadata.emplace("name", name_);
  if (options_.origin && !is_zero(*options_.origin))
    metadata.emplace(kOriginKey, origin_text(*options_.origin));
  if (known_->properties.flat()) metadata.emplace("shading", "flat");
  return metadata;
}

std::optional<std::uint64_t> MeshSequenceSource::frame_count() const {
  if (options_.gaps == Gaps::kSkip) return std::nullopt;
  return files_.size();
}

Result<bool> MeshSequenceSource::read_frame(std::span<float> positions) {
  changed_ = false;
  try {
    while (next_ < files_.size()) {
      if (read_next(positions)) return true;
    }
    return false;
  } catch (const ImportError& error) {
    return error.as_value();
  }
}

/// Reads the next file; false where it is left out.
bool MeshSequenceSource::read_next(std::span<float> positions) {
  const bool held = next_ > stretch_ && files_[next_] == files_[next_ - 1] && !last_.empty();
  if (!held) {
    try {
      read_positions(files_[next_], positions);
      last_.assign(positions.begin(), positions.end());
    } catch (const EmptyInputError& empty) {
      if (options_.empty_frames && files_.size() > 1) {
        read_nothing(files_[next_], empty.what(), positions);
        return true;
      }
      take_empty_frame(empty.what());
      if (options_.gaps == Gaps::kSkip) {
        ++next_;
        return false;
      }
    }
  }
  std::copy(last_.begin(), last_.end(), positions.begin());
  ++next_;
  return true;
}

void MeshSequenceSource::take_empty_frame(const std::string& what) {
  const std::uint64_t frame = first_frame_ + next_;
  if (options_.gaps == Gaps::kRefuse || (options_.gaps == Gaps::kHold && last_.empty())) {
    throw ImportError(
        ErrorCode::kInvalidInput,
        fmt::format("{} (frame {}). {}", what, frame,
                    options_.gaps == Gaps::kRefuse
                        ? "`--gaps hold` shows the frame before it again, `--gaps skip` leaves it out"
                        : "There is no frame before it to hold: `--gaps skip` leaves it out"));
  }
  if (options_.gaps == Gaps::kSkip && next_ + 1 == files_.size() && last_.empty())
    throw ImportError(ErrorCode::kInvalidInput, what + ", and no other file of the sequence has any");
  later_->add(files_[next_], options_.gaps == Gaps::kHold ? "it has no faces: the frame before it is held"
                                                          : "it has no faces and is left out");
}

/// A file without faces is the next frame.
void MeshSequenceSource::read_nothing(const std::string& path, const std::string& what,
                                      std::span<float> positions) {
  if (!known_->shows_nothing) fail_changed(path, what.substr(std::min(what.size(), path.size() + 1)));
  std::copy(last_.begin(), last_.end(), positions.begin());
  later_->add(path, "it has no faces: the frame shows nothing");
  ++next_;
}

void MeshSequenceSource::read_positions(const std::string& path, std::span<float> positions) {
  load(next_);
  if (known_->shows_nothing) fail_changed(path, "has faces where " + known_->file + " has none");
  if (format_ == MeshFormat::kStl) {
    if (next_ == stretch_) stl_.rewind();
    const std::string other = stl_.apply(current_, known_->file);
    if (!other.empty()) {
      loaded_.reset();
      fail_changed(path, other);
    }
  }
  if (current_.vertex_count() != known_->mesh.vertex_count) {
    fail_changed(path, fmt::format("has {} vertices where {} has {}", current_.vertex_count(), known_->file,
                                   known_->mesh.vertex_count));
  }
  // Of STL the facets are matched, and their corners are all there is.
  if (format_ != MeshFormat::kStl) {
    const std::string difference = known_->order.difference(current_, known_->file);
    if (!difference.empty()) fail_changed(path, difference);
    read_values(path);
  }
  if (!last_.empty()) {
    for (const std::uint32_t vertex : current_.misplaced) {
      const auto place = static_cast<std::ptrdiff_t>(3 * std::size_t{vertex});
      std::copy_n(last_.begin() + place, 3, current_.positions.begin() + place);
    }
  }
  loaded_.reset();
  std::copy(current_.positions.begin(), current_.positions.end(), positions.begin());
  place_.assign(current_.positions.begin(), current_.positions.begin() + 3);
  if (next_ == 0) return;
  for (const std::string& note : current_.notes) later_->add(path, note);
}

void MeshSequenceSource::fail_changed(const std::string& path, const std::string& difference) {
  changed_ = true;
  const std::uint64_t frame = first_frame_ + next_;
  throw ImportError(
      ErrorCode::kInvalidInput,
      fmt::format("{} (frame {}) {}. The mesh is another one from there on, and here one has to hold for "
                  "all frames: `--frames {}-{}` takes those of the one before",
                  path, frame, difference, first_frame_ + stretch_, frame - 1));
}

Result<bool> MeshSequenceSource::begin_next_mesh() {
  if (!changed_) return false;
  changed_ = false;
  try {
    begin_stretch();
  } catch (const ImportError& error) {
    return error.as_value();
  }
  return true;
}

Status MeshSequenceSource::skip_frames(std::uint64_t count) {
  // Which file is how many frames on, and where triangles stand, only reading tells.
  if (options_.gaps != Gaps::kRefuse || stl_.reordered()) return FrameSource::skip_frames(count);
  next_ += count;
  loaded_.reset();
  return {};
}

bool MeshSequenceSource::rewind() {
  next_ = 0;
  place_.clear();
  changed_ = false;
  loaded_.reset();
  // So that whoever reads it a second time is told the same.
  seen_.clear();
  if (stretch_ == 0) {
    if (!known_->shows_nothing) {
      seen_.push_back(known_);
      last_.clear();
    }
    return true;
  }
  try {
    begin_stretch();
  } catch (const ImportError&) {
    return false;
  }
  return true;
}

}  // namespace tvg::cli
