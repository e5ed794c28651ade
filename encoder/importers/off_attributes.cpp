#include "encoder/importers/off_attributes.hpp"

#include "encoder/importers/corner_values.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

constexpr std::uint32_t kMostColumns = 9;  // a normal, a colour with alpha and texture coordinates

}  // namespace

void OffAttributes::set_columns(std::string_view letters) {
  normals_ = letters.find('N') != letters.npos;
  texcoords_ = letters.find("ST") != letters.npos;
}

void OffAttributes::read_vertex(TextCursor& cursor) {
  std::array<float, kMostColumns> row{};
  std::uint32_t count = 0;
  for (; count < kMostColumns && !cursor.at_line_end() && cursor.peek() != '#'; ++count)
    row[count] = cursor.number_or_nan();
  if (!any_) width_ = count;
  any_ = true;
  even_ = even_ && count == width_;
  if (even_) numbers_.insert(numbers_.end(), row.begin(), row.begin() + count);
}

Attribute OffAttributes::columns(AttributeKind kind, std::uint32_t first, std::uint32_t count) const {
  Attribute attribute;
  attribute.kind = kind;
  attribute.components = count;
  attribute.values.reserve(numbers_.size() / width_ * count);
  for (std::size_t row = 0; row < numbers_.size(); row += width_) {
    for (std::uint32_t column = first; column < first + count; ++column)
      attribute.values.push_back(numbers_[row + column]);
  }
  return attribute;
}

void OffAttributes::finish(MeshFile& mesh) {
  if (!any_ || (width_ == 0 && even_)) return;
  const std::uint32_t around = (normals_ ? 3 : 0) + (texcoords_ ? 2 : 0);
  const std::uint32_t colour = width_ >= around ? width_ - around : 0;
  if (!even_ || width_ < around || (colour != 0 && colour != 3 && colour != 4)) {
    mesh.notes.push_back(
        "the numbers behind its positions are left out: they are not those that its keyword says");
    return;
  }
  if (const std::size_t cleared = clear_non_finite(numbers_); cleared > 0)
    mesh.notes.push_back(fmt::format("{} numbers behind its positions are none and become 0", cleared));
  if (normals_) mesh.attributes.push_back(columns(AttributeKind::kNormal, 0, 3));
  if (colour > 0) {
    Attribute attribute = columns(AttributeKind::kColour, normals_ ? 3 : 0, colour);
    // Whole numbers go up to 255, others up to 1.
    const bool bytes =
        std::any_of(attribute.values.begin(), attribute.values.end(), [](float x) { return x > 1; });
    if (bytes) {
      for (float& value : attribute.values) value /= 255;
    }
    mesh.attributes.push_back(std::move(attribute));
  }
  if (texcoords_) mesh.attributes.push_back(columns(AttributeKind::kTexcoord, width_ - 2, 2));
}

}  // namespace tvg::cli
