#include "encoder/importers/part_table.hpp"

#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/text_cursor.hpp"

#include <algorithm>
#include <tuple>

namespace tvg::cli {

std::string readable_name(std::string_view text, bool& latin) {
  if (is_plain_text(text)) return std::string(text);
  const bool utf8 = is_metadata_text(text);
  std::string name;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      name += ' ';
    } else if (byte < 0x80 || utf8) {
      name += c;
    } else {
      latin = true;
      name += static_cast<char>(0xc0 | byte >> 6);
      name += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return name;
}

bool PartTable::Key::operator<(const Key& other) const {
  return std::tie(part.object, part.group, part.material, smoothing) <
         std::tie(other.part.object, other.part.group, other.part.material, other.smoothing);
}

void PartTable::set(std::string& name, std::string_view text) {
  name = readable_name(text, latin_);
  changed_ = true;
}

void PartTable::begin_run(std::size_t triangles) {
  changed_ = false;
  const auto [known, is_new] = numbers_.emplace(next_, static_cast<std::uint32_t>(parts_.size()));
  if (is_new) parts_.push_back(next_);
  // A face of too few corners leaves no triangles: the run that it began is then empty.
  if (!runs_.empty() && runs_.back().first == triangles) runs_.pop_back();
  runs_.emplace_back(triangles, known->second);
}

void PartTable::give_to(MeshFile& mesh) {
  if (parts_.size() <= 1 && (parts_.empty() || parts_[0].part == Part{})) return;
  const std::size_t triangles = mesh.faces.size();
  mesh.face_parts.assign(triangles, 0);
  std::vector<bool> used(parts_.size(), false);
  for (std::size_t run = 0; run < runs_.size(); ++run) {
    const std::size_t end = run + 1 < runs_.size() ? runs_[run + 1].first : triangles;
    if (runs_[run].first >= end) continue;
    used[runs_[run].second] = true;
    std::fill(mesh.face_parts.begin() + static_cast<std::ptrdiff_t>(runs_[run].first),
              mesh.face_parts.begin() + static_cast<std::ptrdiff_t>(end), runs_[run].second);
  }
  std::vector<std::uint32_t> numbers(parts_.size(), 0);
  Attribute smoothing;
  smoothing.name = kSmoothingGroup;
  smoothing.domain = AttributeDomain::kPart;
  smoothing.bits = Attribute::kExact;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    if (!used[part]) continue;
    numbers[part] = static_cast<std::uint32_t>(mesh.parts.size());
    mesh.parts.push_back(parts_[part].part);
    smoothing.values.push_back(parts_[part].smoothing);
  }
  for (std::uint32_t& part : mesh.face_parts) part = numbers[part];
  if (std::any_of(smoothing.values.begin(), smoothing.values.end(), [](float group) { return group != 0; }))
    mesh.attributes.push_back(std::move(smoothing));
}

}  // namespace tvg::cli
