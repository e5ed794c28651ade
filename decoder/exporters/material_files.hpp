#pragma once
#include "decoder/exporters/material_data.hpp"

#include <map>
#include <string>
#include <vector>

#include <tvg/properties.hpp>

namespace tvg::cli {

/// Throws ToolError (kUsage) where a file of this name exists and was not written here: it does not begin
/// with kObjMark. `whose`: what the file would belong to, for the message.
void refuse_foreign_file(const std::string& path, const std::string& whose);

/// What lies beside OBJ files: the MTL file of their materials and the images that came with the stream. All
/// of them appear in finish().
class MaterialFiles {
 public:
  /// `path`: of the MTL file.
  explicit MaterialFiles(std::string path) : path_(std::move(path)) {}

  void add_data(const NamedData& data) { data_.add(data); }
  /// The name that OBJ files call it by; empty where there are no materials. Throws ToolError (kUsage) where
  /// another program's file would be overwritten.
  std::string library();
  /// Writes what there is to write, and adds the names of the files.
  void finish(std::vector<std::string>& files);
  std::vector<std::string> notes() const;

 private:
  void choose_images();
  std::string image_path(const std::string& file_name) const;
  std::string mtl() const;
  std::string lines_of(const nlohmann::json& material) const;
  std::string own_lines_of(const nlohmann::json& material) const;
  std::string with_our_images(const std::string& line) const;
  std::string texture_file(const nlohmann::json& texture_info) const;

  std::string path_;
  MaterialData data_;
  bool prepared_ = false;
  std::map<std::string, std::string> image_files_;  ///< name of the data, name of the file beside the MTL
  std::vector<std::string> left_out_;               ///< data that are no image anybody knows
};

}  // namespace tvg::cli
