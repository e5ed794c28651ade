#pragma once
#include <nlohmann/json_fwd.hpp>

#include <tvg/survey.hpp>

// What `tvg info` says of attributes, parts and polygons.
namespace tvg::cli {

/// A table of attributes and one of parts, and the number of polygons, to standard output; nothing where the
/// mesh has none of them.
void print_properties(const SurveyedMesh& mesh);

/// Adds `attributes`, `parts` and `polygons` to an object.
void add_to_json(const SurveyedMesh& mesh, nlohmann::json& json);

}  // namespace tvg::cli
