#pragma once
#include <string>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// What files are written in, as far as it matters for what they can hold. A cache counts as the OBJ beside
/// it.
enum class HeldBy { kObj, kPly, kOff, kStl, kGltf };

/// What of a mesh's properties is lost in a format, each in a few words ("groups", "colours of corners").
std::vector<std::string> lost_in(HeldBy format, const Mesh& mesh, const MeshProperties& properties);

/// Collects what is lost over the meshes of an output, each once.
class LossNotes {
 public:
  void add(HeldBy format, const Mesh& mesh, const MeshProperties& properties);
  void add(const std::string& words);
  /// "FORMAT has no place for A, B and C: left out"; nothing where nothing is lost.
  std::vector<std::string> notes(const std::string& format) const;

 private:
  std::vector<std::string> lost_;
};

}  // namespace tvg::cli
