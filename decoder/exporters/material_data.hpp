#pragma once
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tvg/properties.hpp>

namespace tvg::cli {

/// JSON that a stream brought; nothing where it is none, or nested deeper than anybody writes by hand.
std::optional<nlohmann::json> parse_json(std::span<const std::uint8_t> bytes);

/// The member of an object; null where there is none, or `value` is no object.
const nlohmann::json& member(const nlohmann::json& value, const char* name);
/// The elements of an array; an empty array where it is none.
const nlohmann::json& array_of(const nlohmann::json& value, const char* name);
/// A text; "" where it is none.
std::string text_of(const nlohmann::json& value, const char* name);
/// A number from 0 on that counts elements; nothing where it is none.
std::optional<std::size_t> index_of(const nlohmann::json& value, const char* name);
/// The numbers of an array, `count` of them; `otherwise` where it is none.
std::vector<double> numbers_of(const nlohmann::json& value, const char* name, std::size_t count,
                               double otherwise);

/// The type of an image file by its first bytes ("image/png"); "" where it is none of those that glTF and
/// engines know.
std::string image_type(std::span<const std::uint8_t> bytes);

/// What a stream's data say of materials and how they look: "materials" and "image/...".
class MaterialData {
 public:
  /// Takes what it has use for.
  void add(const NamedData& data);

  /// The JSON object of "materials"; an empty one where there is none.
  const nlohmann::json& json() const { return json_; }
  /// By the name of the data; null where there is none.
  const std::vector<std::uint8_t>* image(const std::string& name) const;
  const std::map<std::string, std::vector<std::uint8_t>>& images() const { return images_; }
  bool empty() const { return array_of(json_, "materials").empty(); }
  /// "materials" came, and could not be read.
  bool unreadable() const { return unreadable_; }

 private:
  nlohmann::json json_ = nlohmann::json::object();
  std::map<std::string, std::vector<std::uint8_t>> images_;
  bool unreadable_ = false;
};

}  // namespace tvg::cli
