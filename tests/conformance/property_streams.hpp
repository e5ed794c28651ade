#pragma once
#include "stream_toolbox.hpp"

// Conformance streams of meshes that have attributes, parts and polygons (format-spec §5.7 to §5.9), and of
// frames that are their meshes' shapes (§7.10).
namespace tvg::conformance {

Stream make_attributes();
Stream make_attributes_shape();
Stream make_attributes_exact();
Stream make_attributes_soup();
Stream make_animated();
Stream make_animated_shape();
Stream make_animated_exact();
Stream make_shape();

}  // namespace tvg::conformance
