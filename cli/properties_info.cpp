#include "cli/properties_info.hpp"

#include "cli/property_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>

namespace tvg::cli {

namespace {

/// A list that is longer than this is for programs.
constexpr std::size_t kMostParts = 40;

/// "12", or "exact".
std::string bits_of(const SurveyedAttribute& attribute) {
  return attribute.bits == Attribute::kExact ? "exact" : fmt::format("{}", attribute.bits);
}

/// " (animated, 123 B)".
std::string animated_note(const SurveyedMesh& mesh, std::size_t i, std::span<const std::uint64_t> bytes) {
  if (!mesh.attributes[i].animated) return "";
  return i < bytes.size() ? fmt::format(" (animated, {} B)", bytes[i]) : " (animated)";
}

void print_attributes(const SurveyedMesh& mesh, std::span<const std::uint64_t> animated_bytes) {
  if (mesh.attributes.empty()) return;
  fmt::print("\nattributes, {} B\n  {:<9} {:<7} {:>10} {:>6} {:>10}  {}\n", mesh.parts.attributes_bytes,
             "kind", "domain", "components", "bits", "values", "name");
  for (std::size_t i = 0; i < mesh.attributes.size(); ++i) {
    const SurveyedAttribute& attribute = mesh.attributes[i];
    fmt::print("  {:<9} {:<7} {:>10} {:>6} {:>10}  {}{}\n", kind_name(attribute.kind),
               domain_name(attribute.domain), attribute.components, bits_of(attribute), attribute.values,
               attribute.name, animated_note(mesh, i, animated_bytes));
  }
}

void print_parts(const SurveyedMesh& mesh) {
  if (mesh.face_parts.empty()) return;
  fmt::print("\n{} parts, {} B\n  {:>10}  {}\n", mesh.face_parts.size(), mesh.parts.parts_bytes, "faces",
             "object, group, material");
  for (std::size_t i = 0; i < mesh.face_parts.size() && i < kMostParts; ++i) {
    const auto& [part, faces] = mesh.face_parts[i];
    fmt::print("  {:>10}  '{}', '{}', '{}'\n", faces, part.object, part.group, part.material);
  }
  if (mesh.face_parts.size() > kMostParts)
    fmt::print("  and {} more, which --json lists\n", mesh.face_parts.size() - kMostParts);
}

}  // namespace

void print_properties(const SurveyedMesh& mesh, std::span<const std::uint64_t> animated_bytes) {
  print_attributes(mesh, animated_bytes);
  print_parts(mesh);
  if (mesh.polygons > 0)
    fmt::print("\n{} polygons of more than three corners, {} B\n", mesh.polygons, mesh.parts.polygons_bytes);
}

void add_to_json(const SurveyedMesh& mesh, std::span<const std::uint64_t> animated_bytes,
                 nlohmann::json& json) {
  json["attributes"] = nlohmann::json::array();
  for (std::size_t i = 0; i < mesh.attributes.size(); ++i) {
    const SurveyedAttribute& attribute = mesh.attributes[i];
    nlohmann::json one = {{"name", attribute.name},
                          {"kind", kind_name(attribute.kind)},
                          {"domain", domain_name(attribute.domain)},
                          {"components", attribute.components},
                          {"bits", nullptr},
                          {"animated", attribute.animated},
                          {"values", attribute.values}};
    if (attribute.bits != Attribute::kExact) one["bits"] = attribute.bits;
    if (attribute.animated && i < animated_bytes.size()) one["frame_bytes"] = animated_bytes[i];
    json["attributes"].push_back(std::move(one));
  }
  json["parts"] = nlohmann::json::array();
  for (const auto& [part, faces] : mesh.face_parts) {
    json["parts"].push_back(
        {{"object", part.object}, {"group", part.group}, {"material", part.material}, {"faces", faces}});
  }
  json["polygons"] = mesh.polygons;
}

}  // namespace tvg::cli
