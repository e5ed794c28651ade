#pragma once

namespace tvg::cli {

/// What becomes of the normals of an input.
enum class NormalsChoice {
  kAuto,  ///< kept, but where a player finds them by itself
  kKeep,
  kDrop,
};

}  // namespace tvg::cli
