#pragma once
#include "player/view/gl_objects.hpp"

namespace tvg::player {

/// What a program for the mesh does.
struct MeshShaderFeatures {
  bool flat = false;       ///< one normal per face
  bool wireframe = false;  ///< edges over the surface
  bool values = false;     ///< colours by value
  bool points = false;     ///< vertices without faces
  bool surface = false;    ///< colours of vertices, times a factor and a picture; not with `values`
};

ShaderText mesh_shader(const MeshShaderFeatures& features);
ShaderText background_shader();
ShaderText grid_shader();

}  // namespace tvg::player
