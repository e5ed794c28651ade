#pragma once
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <tvg/properties.hpp>

namespace tvg::cli {

/// Of one piece of data, decoded: no stream has more (format-spec §4.8).
inline constexpr std::uint64_t kMostDataBytes = std::uint64_t{1} << 26;

/// Gives names that none had before.
class UniqueNames {
 public:
  /// `wanted`, as a stream may have it, or `otherwise` where that is empty; with a number behind it where
  /// that name has been given.
  std::string take(const std::string& wanted, const std::string& otherwise);

 private:
  std::set<std::string> taken_;
  std::map<std::string, std::size_t> next_;  // number of each name
};

/// Image files that go with a scene, each as "image/NAME".
class SceneImages {
 public:
  /// Adds a file and returns the name of its data; nothing where it is larger than data may be.
  std::optional<std::string> add(const std::string& name, std::vector<std::uint8_t> bytes);
  std::vector<NamedData> finish() { return std::move(data_); }

 private:
  UniqueNames names_;
  std::vector<NamedData> data_;
};

/// JSON as data. Text in it that is no UTF-8 is replaced by U+FFFD.
NamedData json_data(std::string name, const nlohmann::json& json);

}  // namespace tvg::cli
