#pragma once
#include "encoder/importers/normals_choice.hpp"

namespace tvg::cli {

/// What is kept of an input beside its positions.
struct PropertyOptions {
  bool wanted = true;  ///< false: nothing but positions
  NormalsChoice normals = NormalsChoice::kAuto;
  /// Linear colours get as many bits as dark ones need, where they are no whole 255ths.
  bool fine_linear_colours = true;
  bool embed_textures = false;  ///< the files of textures, not their names only
};

}  // namespace tvg::cli
