#pragma once
#include <nlohmann/json_fwd.hpp>

#include <tvg/survey.hpp>

// The runs of frames of one mesh that a stream has.
namespace tvg::cli {

/// A table on standard output; nothing where there is one mesh.
void print_stretches(const StreamSurvey& stream);

/// The same as a list of objects.
nlohmann::json json_of_stretches(const StreamSurvey& stream);

}  // namespace tvg::cli
