#include <tvg/geometry.hpp>

namespace tvg {

OneRings::OneRings(const Mesh& mesh)
    : faces_(mesh.vertex_count, [&mesh](auto&& put) {
        for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
          const auto& [a, b, c] = mesh.faces[f];
          put(a, f);
          if (b != a) put(b, f);
          if (c != a && c != b) put(c, f);
        }
      }) {}

}  // namespace tvg
