#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>

#include <tvg/properties.hpp>

namespace tvg::cli {

/// What glTF has no word for of a part, as `extras` of its primitive, from which the importer gets it back
/// (docs/formats.md): `object`, `group`; `polygons`, [faces, corners, faces, corners, ...] in the order of
/// its triangles; `values`, the numbers of each attribute of parts by its name. Null where there is nothing.
/// `faces`: those of the part, by their numbers in the mesh, in the order in which the primitive has them.
nlohmann::json gltf_part_extras(const MeshProperties& properties, std::size_t part,
                                std::span<const std::uint32_t> faces);

}  // namespace tvg::cli
