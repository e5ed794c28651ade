#pragma once
#include "encoder/importers/corner_match.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/normal_shading.hpp"
#include "encoder/importers/property_options.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tvg/properties.hpp>

namespace tvg::cli {

/// What files of one mesh have beside positions: parts and polygons are those of the first, and so are the
/// attributes that do not change. Which change, and where their seams are, a look at some of the files tells
/// before the frames are read: begin with the first, look at others, settle.
///
/// Values belong to corners, whatever indices a file gives them: what is drawn is compared. An animated
/// attribute of corners has a value for each set of corners around a vertex that agree in all files looked
/// at.
class StretchProperties {
 public:
  StretchProperties() = default;
  StretchProperties(const MeshFile& first, const PropertyOptions& options);

  /// Whether other files have to be read with their properties.
  bool vary() const { return !tracks_.empty(); }
  /// Whether the first file has attributes, and all of them were left out.
  bool all_left_out() const { return tracks_.empty() && file_attributes_ > 0; }
  /// Looks at another file, which has the triangles `faces` of the first, perhaps turned and in another
  /// order.
  void look_at(const MeshFile& other, std::span<const Face> faces);
  /// Says what properties() are from now on. `still`: the values do not come with frames, though positions
  /// may. Notes for the user are added.
  void settle(std::span<const Face> faces, bool still, std::vector<std::string>& notes);

  const MeshProperties& properties() const { return properties_; }
  /// The values of an animated attribute in the file that was read last.
  std::span<const float> values(std::size_t attribute) const {
    return properties_.attributes[attribute].values;
  }
  /// Whether normals were left out that are those of the faces, each by itself.
  bool flat() const { return flat_; }

  /// Reads the values of a file with the same triangles. Returns what is another thing than in the first and
  /// was not to change ("texture coordinates"), or nothing; `note` is what a user should know of the values.
  std::string read(const MeshFile& file, std::span<const Face> faces, std::string& note);

 private:
  /// What is known of an attribute while files are looked at, in the order of properties().
  struct Track {
    std::size_t occurrence = 0;  // among the attributes of the same kind, name and number of components
    bool changes = false;
    std::vector<std::uint32_t> classes;  // [corner], which of those that agree; empty where vertices do
    std::uint32_t class_count = 0;
    std::optional<NormalShading> shading;  // of normals, as far as was looked
  };

  const Attribute* find(const MeshFile& file, std::size_t attribute) const;
  void refine(Track& track, const Attribute& values, std::span<const Face> faces,
              const CornerMatch& match) const;
  std::string why_dropped(std::size_t attribute, bool still) const;
  void drop(std::size_t attribute);
  bool take(std::size_t attribute, const Attribute& values, std::span<const Face> faces,
            const CornerMatch& match);

  PropertyOptions options_;
  MeshProperties properties_;
  std::vector<Track> tracks_;
  std::size_t file_attributes_ = 0;  // those of the first file, without those of parts
  bool flat_ = false;
};

}  // namespace tvg::cli
