#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>

#include <tvg/survey.hpp>

// What `tvg info` says of attributes, parts and polygons.
namespace tvg::cli {

/// A table of attributes and one of parts, and the number of polygons, to standard output; nothing where the
/// mesh has none of them. `animated_bytes`, [attribute], is what the values of those that are animated take
/// of frames; empty where that is not known.
void print_properties(const SurveyedMesh& mesh, std::span<const std::uint64_t> animated_bytes);

/// Adds `attributes`, `parts` and `polygons` to an object.
void add_to_json(const SurveyedMesh& mesh, std::span<const std::uint64_t> animated_bytes,
                 nlohmann::json& json);

}  // namespace tvg::cli
