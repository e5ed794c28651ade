#include "encoder/importers/scene_data.hpp"

#include "encoder/importers/scene_attributes.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tvg::cli {

std::string UniqueNames::take(const std::string& wanted, const std::string& otherwise) {
  // With room for a number, and for what names of data begin with.
  const std::string plain = plain_name(wanted.empty() ? otherwise : wanted, kLongestName - 64);
  std::string name = plain;
  while (!taken_.insert(name).second) name = fmt::format("{} {}", plain, ++next_[plain]);
  return name;
}

std::optional<std::string> SceneImages::add(const std::string& name, std::vector<std::uint8_t> bytes) {
  if (bytes.size() > kMostDataBytes) return std::nullopt;
  data_.push_back({"image/" + names_.take(name, fmt::format("{}", data_.size())), std::move(bytes)});
  return data_.back().name;
}

NamedData json_data(std::string name, const nlohmann::json& json) {
  const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return {std::move(name), {text.begin(), text.end()}};
}

}  // namespace tvg::cli
