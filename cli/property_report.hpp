#pragma once
#include <nlohmann/json_fwd.hpp>

#include <tvg/properties.hpp>
#include <tvg/property_metrics.hpp>

// What commands say of attributes, parts and polygons, and of how they came out.
namespace tvg::cli {

/// "texcoord", "normal", "colour", "generic".
const char* kind_name(AttributeKind kind);
/// "vertex", "corner", "part".
const char* domain_name(AttributeDomain domain);

/// A line for each attribute and for parts, materials and polygons, to standard output; nothing where neither
/// side has any.
void print_property_report(const PropertyReport& report);

/// Adds `attributes`, `parts`, `materials`, `polygons` and `unmatched_faces` to an object.
void add_to_json(const PropertyReport& report, nlohmann::json& json);

}  // namespace tvg::cli
