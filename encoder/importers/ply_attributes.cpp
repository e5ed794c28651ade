#include "encoder/importers/ply_attributes.hpp"

#include "encoder/importers/corner_values.hpp"
#include "encoder/importers/text_cursor.hpp"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

double largest_of(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
      return std::numeric_limits<std::int8_t>::max();
    case PlyType::kUint8:
      return std::numeric_limits<std::uint8_t>::max();
    case PlyType::kInt16:
      return std::numeric_limits<std::int16_t>::max();
    case PlyType::kUint16:
      return std::numeric_limits<std::uint16_t>::max();
    case PlyType::kInt32:
      return std::numeric_limits<std::int32_t>::max();
    case PlyType::kUint32:
      return std::numeric_limits<std::uint32_t>::max();
    case PlyType::kFloat32:
    case PlyType::kFloat64:
      break;
  }
  return 1;
}

bool is_axis(const std::string& name) {
  return name == "x" || name == "y" || name == "z";
}

}  // namespace

PlyAttributes::PlyAttributes(const PlyElement& vertex) : columns_(vertex.properties.size()) {
  take_group(vertex, AttributeKind::kTexcoord, {"s", "t"});
  take_group(vertex, AttributeKind::kTexcoord, {"u", "v"});
  take_group(vertex, AttributeKind::kTexcoord, {"texture_u", "texture_v"});
  take_group(vertex, AttributeKind::kTexcoord, {"texture_s", "texture_t"});
  take_group(vertex, AttributeKind::kNormal, {"nx", "ny", "nz"});
  if (!take_group(vertex, AttributeKind::kColour, {"red", "green", "blue", "alpha"}))
    take_group(vertex, AttributeKind::kColour, {"red", "green", "blue"});
  if (!take_group(vertex, AttributeKind::kColour,
                  {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"}))
    take_group(vertex, AttributeKind::kColour, {"diffuse_red", "diffuse_green", "diffuse_blue"});
  for (std::size_t p = 0; p < vertex.properties.size(); ++p) {
    const PlyProperty& property = vertex.properties[p];
    if (wants(p) || is_axis(property.name)) continue;
    if (property.is_list || attributes_.size() == kMaxAttributes || !is_plain_text(property.name)) {
      left_out_.push_back(is_plain_text(property.name) ? property.name : "(binary)");
      continue;
    }
    columns_[p].attribute = attributes_.size();
    attributes_.emplace_back().name = property.name;
  }
  rounded_.resize(attributes_.size());
}

bool PlyAttributes::take_group(const PlyElement& vertex, AttributeKind kind,
                               const std::vector<const char*>& names) {
  std::vector<std::size_t> properties;
  for (const char* name : names) {
    const std::size_t p = vertex.find(name);
    if (p == vertex.properties.size() || vertex.properties[p].is_list || wants(p)) return false;
    properties.push_back(p);
  }
  for (std::size_t component = 0; component < properties.size(); ++component) {
    Column& column = columns_[properties[component]];
    column.attribute = attributes_.size();
    column.component = component;
    column.largest = largest_of(vertex.properties[properties[component]].type);
  }
  Attribute& attribute = attributes_.emplace_back();
  attribute.kind = kind;
  attribute.components = static_cast<std::uint32_t>(names.size());
  return true;
}

void PlyAttributes::begin_vertex() {
  for (Attribute& attribute : attributes_)
    attribute.values.insert(attribute.values.end(), attribute.components, 0.0F);
}

void PlyAttributes::set(std::size_t property, double value) {
  const Column& column = columns_[property];
  Attribute& attribute = attributes_[column.attribute];
  constexpr double kLargest = std::numeric_limits<float>::max();
  const double scaled = value / column.largest;
  const float kept =
      std::abs(scaled) <= kLargest ? static_cast<float>(scaled) : std::numeric_limits<float>::quiet_NaN();
  if (double{kept} != scaled && !std::isnan(value)) ++rounded_[column.attribute];
  attribute.values[attribute.values.size() - attribute.components + column.component] = kept;
}

void PlyAttributes::finish(MeshFile& mesh) {
  for (std::size_t i = 0; i < attributes_.size(); ++i) {
    Attribute& attribute = attributes_[i];
    if (attribute.kind == AttributeKind::kGeneric && rounded_[i] > 0) {
      mesh.notes.push_back(
          fmt::format("{} values of the property '{}' are rounded to float32", rounded_[i], attribute.name));
    }
    if (const std::size_t cleared = clear_non_finite(attribute.values); cleared > 0) {
      mesh.notes.push_back(
          fmt::format("{} values of its properties are no numbers that float32 holds and become 0", cleared));
    }
    mesh.attributes.push_back(std::move(attribute));
  }
  if (!left_out_.empty())
    mesh.notes.push_back(fmt::format("the vertex properties {} are left out", fmt::join(left_out_, ", ")));
}

void PlyFaceTexcoords::add_face(const std::vector<float>& list, std::uint32_t corners, std::size_t triangle,
                                MeshFile& mesh) {
  if (mesh.faces.size() == triangle) return;
  if (list.size() != 2 * std::size_t{corners}) {
    if (!list.empty()) ++odd_lists_;
    return;
  }
  corners_.resize(3 * triangle, CornerValues::kNone);
  const auto first = static_cast<std::uint32_t>(values_.size() / 2);
  values_.insert(values_.end(), list.begin(), list.end());
  for (std::uint32_t corner = 2; corner < corners; ++corner)
    corners_.insert(corners_.end(), {first, first + corner - 1, first + corner});
}

void PlyFaceTexcoords::finish(MeshFile& mesh) {
  if (odd_lists_ > 0) {
    mesh.notes.push_back(fmt::format(
        "{} lists 'texcoord' are left out: they have not two numbers for each corner", odd_lists_));
  }
  if (corners_.empty()) return;
  corners_.resize(3 * mesh.faces.size(), CornerValues::kNone);
  Attribute attribute;
  attribute.kind = AttributeKind::kTexcoord;
  attribute.components = 2;
  attribute.values = std::move(values_);
  attribute.corners = std::move(corners_);
  if (const std::size_t cleared = clear_non_finite(attribute.values); cleared > 0)
    mesh.notes.push_back(fmt::format("{} of its texture coordinates are no numbers and become 0", cleared));
  share_values(attribute, mesh.faces);
  const std::size_t missing = settle_corners(attribute, mesh.faces, mesh.vertex_count());
  if (missing > 0)
    mesh.notes.push_back(fmt::format("{} corners have no texture coordinates: 0 stands for them", missing));
  mesh.attributes.push_back(std::move(attribute));
}

}  // namespace tvg::cli
