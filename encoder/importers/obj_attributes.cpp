#include "encoder/importers/obj_attributes.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

void ObjAttributes::Channel::read(TextCursor& cursor) {
  std::uint32_t count = 0;
  for (; count < stride; ++count) {
    cursor.skip_blanks_and_continuations();
    if (cursor.at_line_end() || cursor.peek() == '#') break;
    values.push_back(cursor.number_or_nan());
  }
  values.insert(values.end(), stride - count, 0.0F);
  widest = std::max(widest, count);
}

void ObjAttributes::Channel::add_corner(std::uint32_t corner, std::int64_t index, std::size_t triangles,
                                        std::size_t line) {
  const auto count = static_cast<std::int64_t>(values.size() / stride);
  constexpr std::int64_t kMost = std::numeric_limits<std::uint32_t>::max() - 1;
  std::uint32_t value = CornerValues::kNone;
  if (index < 0 && index >= -count) {
    value = static_cast<std::uint32_t>(count + index);
  } else if (index < 0 || index > kMost) {
    if (bad_line == 0) bad_line = line;
  } else if (index > 0) {
    value = static_cast<std::uint32_t>(index - 1);
    if (index > largest) {  // its line may follow
      largest = static_cast<std::uint32_t>(index);
      largest_line = line;
    }
  }
  corners.add(corner, value, triangles);
}

void ObjAttributes::read_behind_position(TextCursor& cursor) {
  if (cursor.at_line_end() || cursor.peek() == '#') return;
  std::array<float, 4> numbers{};
  std::size_t count = 0;
  for (; count < 4 && !cursor.at_line_end() && cursor.peek() != '#'; ++count)
    numbers[count] = cursor.number_or_nan();
  if (count < 3) return;  // a weight, as curves have it
  // Those before it that have none are white.
  colours_.resize(4 * (mesh_.vertex_count() - 1), 1.0F);
  if (count == 3) numbers[3] = 1;
  alpha_ = alpha_ || count == 4;
  colours_.insert(colours_.end(), numbers.begin(), numbers.end());
  ++coloured_;
}

void ObjAttributes::read_corner(TextCursor& cursor, std::uint32_t corner) {
  std::array<std::int64_t, 2> indices{};
  for (std::size_t i = 0; i < 2 && cursor.peek() == '/'; ++i) {
    cursor.advance();
    const char next = cursor.peek();
    if (next == '/' || TextCursor::is_delimiter(next)) continue;
    if (next != '-' && (next < '0' || next > '9')) return;  // the reader of corners says what is right
    indices[i] = cursor.integer_prefix();
  }
  const std::size_t triangles = mesh_.faces.size();
  texcoords_.add_corner(corner, indices[0], triangles, cursor.line());
  normals_.add_corner(corner, indices[1], triangles, cursor.line());
}

void ObjAttributes::finish() {
  give(texcoords_, AttributeKind::kTexcoord);
  give(normals_, AttributeKind::kNormal);
  give_colours();
}

void ObjAttributes::give(Channel& channel, AttributeKind kind) {
  if (!channel.corners.used() && channel.bad_line == 0) {
    if (!channel.values.empty())
      mesh_.notes.push_back(fmt::format("its {} are left out: no face uses them", channel.what));
    return;
  }
  const std::size_t count = channel.values.size() / channel.stride;
  if (channel.bad_line != 0 || channel.largest > count) {
    mesh_.notes.push_back(fmt::format("its {} are left out: the face in line {} uses one that is not there",
                                      channel.what,
                                      channel.bad_line != 0 ? channel.bad_line : channel.largest_line));
    return;
  }
  Attribute attribute;
  attribute.kind = kind;
  attribute.domain = AttributeDomain::kCorner;
  const auto third_is_used = [&] {
    for (std::size_t i = 2; i < channel.values.size(); i += 3) {
      if (channel.values[i] != 0) return true;
    }
    return false;
  };
  attribute.components = kind == AttributeKind::kNormal || (channel.widest > 2 && third_is_used()) ? 3
                         : channel.widest > 1                                                      ? 2
                                                                                                   : 1;
  const std::size_t components = attribute.components;
  for (std::size_t value = 0; value < count && components < channel.stride; ++value) {
    std::copy_n(channel.values.begin() + static_cast<std::ptrdiff_t>(value * channel.stride), components,
                channel.values.begin() + static_cast<std::ptrdiff_t>(value * components));
  }
  channel.values.resize(count * components);
  attribute.values = std::move(channel.values);
  attribute.corners = channel.corners.take(mesh_.faces.size());
  if (const std::size_t cleared = clear_non_finite(attribute.values); cleared > 0)
    mesh_.notes.push_back(fmt::format("{} of its {} are no numbers and become 0", cleared, channel.what));
  if (attribute.corners.empty()) return;
  const std::size_t missing = settle_corners(attribute, mesh_.faces, mesh_.vertex_count());
  if (missing > 0)
    mesh_.notes.push_back(fmt::format("{} corners have no {}: 0 stands for them", missing, channel.what));
  mesh_.attributes.push_back(std::move(attribute));
}

void ObjAttributes::give_colours() {
  if (coloured_ == 0) return;
  const std::size_t vertices = mesh_.vertex_count();
  if (coloured_ < vertices)
    mesh_.notes.push_back(fmt::format("{} vertices have no colour and become white", vertices - coloured_));
  colours_.resize(4 * vertices, 1.0F);
  Attribute attribute;
  attribute.kind = AttributeKind::kColour;
  attribute.components = alpha_ ? 4 : 3;
  attribute.values.reserve(attribute.components * vertices);
  float largest = 0;
  for (std::size_t i = 0; i < colours_.size(); ++i) {
    if (i % 4 == 3 && !alpha_) continue;
    attribute.values.push_back(colours_[i]);
    if (i % 4 != 3) largest = std::max(largest, colours_[i]);
  }
  if (const std::size_t cleared = clear_non_finite(attribute.values); cleared > 0)
    mesh_.notes.push_back(fmt::format("{} numbers of its colours are none and become 0", cleared));
  mesh_.attributes.push_back(std::move(attribute));
  if (largest > 1) {
    mesh_.notes.push_back(fmt::format(
        "its colours go up to {:.6g} and are kept as they are, where 1 is the brightest", largest));
  }
}

}  // namespace tvg::cli
