#pragma once
#include "encoder/importers/normals_choice.hpp"

#include <array>
#include <cstddef>

#include <tvg/properties.hpp>

namespace tvg::cli {

/// What is kept of an input beside its positions, and how finely.
struct PropertyOptions {
  bool wanted = true;  ///< false: nothing but positions
  NormalsChoice normals = NormalsChoice::kAuto;
  bool embed_textures = false;  ///< the files of textures, not their names only
  /// Attribute::bits of each AttributeKind, whose numbers are the places.
  std::array<int, 4> bits = {Attribute::kBitsOfKind, Attribute::kBitsOfKind, Attribute::kBitsOfKind,
                             Attribute::kBitsOfKind};

  int bits_of(AttributeKind kind) const { return bits[static_cast<std::size_t>(kind)]; }
};

}  // namespace tvg::cli
