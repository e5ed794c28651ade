#pragma once
#include "container/mesh_payload.hpp"

#include <tvg/survey.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// Says what a mesh has beside its connectivity, which takes decoding it where it has anything: that is all
/// that Decoder::properties() would say, but for the values. Errors are those of decoding.
Status survey_properties(const MeshLayout& layout, const StreamLimits& limits, SurveyedMesh& surveyed);

}  // namespace tvg
