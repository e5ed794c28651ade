#include "cli/property_report.hpp"

#include "cli/surface_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>

namespace tvg::cli {

namespace {

const char* side_with(Presence presence) {
  switch (presence) {
    case Presence::kOriginalOnly:
      return "original";
    case Presence::kDecodedOnly:
      return "decoded";
    default:
      return "both";
  }
}

/// "texcoord 'UVMap'", or how else it is called on the decoded side.
std::string title_of(const AttributeDifference& attribute) {
  std::string title = kind_name(attribute.kind);
  if (!attribute.name.empty()) title += fmt::format(" '{}'", attribute.name);
  if (attribute.decoded_name != attribute.name)
    title += attribute.decoded_name.empty() ? " (now without a name)"
                                            : fmt::format(" (now '{}')", attribute.decoded_name);
  return title;
}

void print_attribute(const AttributeDifference& attribute) {
  fmt::print("  {:<24}", title_of(attribute));
  if (attribute.presence != Presence::kBoth) {
    fmt::print(" only in the {}\n",
               attribute.presence == Presence::kOriginalOnly ? "original" : "decoded frames");
    return;
  }
  const bool degrees = attribute.kind == AttributeKind::kNormal;
  fmt::print("{:>14.6g} maximum, {:.6g} {}{}{}\n", attribute.max_difference,
             degrees ? attribute.mean_difference : attribute.rms_difference, degrees ? "mean" : "RMS",
             degrees ? ", in degrees" : "", attribute.animated ? ", over all frames" : "");
}

void print_count(const char* name, const CountDifference& count, const char* unit) {
  if (!count.present()) return;
  const std::string counts = count.original == count.decoded
                                 ? fmt::format("{}", count.original)
                                 : fmt::format("{} and {}", count.original, count.decoded);
  if (count.different == 0) {
    fmt::print("  {:<24}{:>14} equal\n", name, counts);
  } else {
    fmt::print("  {:<24}{:>14} DIFFERENT: {} {}\n", name, counts, count.different, unit);
  }
}

nlohmann::json json_of(const CountDifference& count) {
  return {{"original", count.original},
          {"decoded", count.decoded},
          {"different", count.different},
          {"equal", count.different == 0}};
}

}  // namespace

const char* kind_name(AttributeKind kind) {
  switch (kind) {
    case AttributeKind::kTexcoord:
      return "texcoord";
    case AttributeKind::kNormal:
      return "normal";
    case AttributeKind::kColour:
      return "colour";
    default:
      return "generic";
  }
}

const char* domain_name(AttributeDomain domain) {
  switch (domain) {
    case AttributeDomain::kVertex:
      return "vertex";
    case AttributeDomain::kCorner:
      return "corner";
    default:
      return "part";
  }
}

void print_property_report(const PropertyReport& report) {
  for (const AttributeDifference& attribute : report.attributes) print_attribute(attribute);
  print_count("parts", report.parts, "faces are of another");
  print_count("materials", report.materials, "faces have another");
  print_count("polygons", report.polygons, "are on one side only");
  if (report.unmatched_faces > 0)
    fmt::print("  {:<24}{:>14} on one side only\n", "faces", report.unmatched_faces);
}

void add_to_json(const PropertyReport& report, nlohmann::json& json) {
  json["attributes"] = nlohmann::json::array();
  for (const AttributeDifference& attribute : report.attributes) {
    json["attributes"].push_back({{"name", attribute.name},
                                  {"decoded_name", attribute.decoded_name},
                                  {"kind", kind_name(attribute.kind)},
                                  {"domain", domain_name(attribute.domain)},
                                  {"animated", attribute.animated},
                                  {"side", side_with(attribute.presence)},
                                  {"unit", attribute.kind == AttributeKind::kNormal ? "degrees" : "value"},
                                  {"values", attribute.values},
                                  {"max_difference", finite_or_null(attribute.max_difference)},
                                  {"rms_difference", finite_or_null(attribute.rms_difference)},
                                  {"mean_difference", finite_or_null(attribute.mean_difference)}});
  }
  json["parts"] = json_of(report.parts);
  json["materials"] = json_of(report.materials);
  json["polygons"] = json_of(report.polygons);
  json["unmatched_faces"] = report.unmatched_faces;
}

}  // namespace tvg::cli
