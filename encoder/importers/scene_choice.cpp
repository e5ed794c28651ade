#include "encoder/importers/scene_choice.hpp"

#include "tool/tool_error.hpp"

#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <optional>
#include <set>

namespace tvg::cli {

namespace {

/// `text` as a number below `limit`.
std::optional<std::size_t> to_number(const std::string& text, std::size_t limit) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number >= limit) return std::nullopt;
  return number;
}

/// What a name fits.
struct Matches {
  std::set<std::size_t> nodes;                                // of that name
  std::map<std::size_t, std::set<std::size_t>> mesh_holders;  // of that name, and the nodes that hold them

  bool empty() const { return nodes.empty() && mesh_holders.empty(); }
  /// Formats that cut a mesh by materials give one node several meshes of one name, which are one thing.
  bool ambiguous() const {
    if (nodes.size() > 1) return true;
    if (mesh_holders.size() < 2) return false;
    const std::set<std::size_t>& first = mesh_holders.begin()->second;
    for (const auto& [mesh, holders] : mesh_holders) {
      if (holders != first) return true;
    }
    return false;
  }
};

class Chooser {
 public:
  explicit Chooser(const Scene& scene) : scene_(scene), chosen_(scene.instances.size(), 0) {}

  void take(const std::string& wanted, std::vector<std::string>& notes) {
    Matches matches;
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      const SceneInstance& instance = scene_.instances[i];
      const bool by_mesh = scene_.mesh_names[instance.mesh] == wanted;
      const bool by_node = scene_.nodes.list()[instance.node].name == wanted;
      if (by_mesh) matches.mesh_holders[instance.mesh].insert(instance.node);
      if (by_node) matches.nodes.insert(instance.node);
      if (by_mesh || by_node) chosen_[i] = 1;
    }
    if (matches.empty() && !take_number(wanted)) fail(wanted);
    if (!matches.ambiguous()) return;
    std::set<std::size_t> meshes;
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      const SceneInstance& instance = scene_.instances[i];
      if (matches.nodes.contains(instance.node) || matches.mesh_holders.contains(instance.mesh)) {
        meshes.insert(instance.mesh);
      }
    }
    notes.push_back(
        fmt::format("{}: --mesh {}: several have that name and all are taken; a number picks one "
                    "mesh: {}",
                    scene_.path, wanted, fmt::join(meshes, ", ")));
  }

  std::vector<char> chosen() && { return std::move(chosen_); }

 private:
  bool take_number(const std::string& wanted) {
    const std::optional<std::size_t> number = to_number(wanted, scene_.mesh_names.size());
    bool found = false;
    for (std::size_t i = 0; number && i < chosen_.size(); ++i) {
      if (scene_.instances[i].mesh != *number) continue;
      chosen_[i] = 1;
      found = true;
    }
    return found;
  }

  [[noreturn]] void fail(const std::string& wanted) const {
    std::set<std::string> names;
    for (const SceneInstance& instance : scene_.instances) {
      names.insert(scene_.mesh_names[instance.mesh]);
      names.insert(scene_.nodes.list()[instance.node].name);
    }
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("--mesh {}: {} has no mesh of that name or number; it has \"{}\"", wanted,
                                scene_.path, fmt::join(names, "\", \"")));
  }

  const Scene& scene_;
  std::vector<char> chosen_;
};

}  // namespace

std::size_t find_clip(const Scene& scene, const std::string& wanted) {
  std::string names;
  std::vector<std::size_t> matches;
  for (std::size_t i = 0; i < scene.clip_names.size(); ++i) {
    if (scene.clip_names[i] == wanted) matches.push_back(i);
    names += fmt::format("{}{} \"{}\"", i == 0 ? "" : ", ", i, scene.clip_names[i]);
  }
  if (matches.size() == 1) return matches.front();
  if (matches.size() > 1) {
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("--clip {}: {} clips of {} have that name; say which by its number: {}",
                                wanted, matches.size(), scene.path, fmt::join(matches, ", ")));
  }
  if (const std::optional<std::size_t> number = to_number(wanted, scene.clip_names.size())) return *number;
  throw ToolError(ExitStatus::kUsage,
                  fmt::format("--clip {}: {} has no clip of that name or number; {}", wanted, scene.path,
                              names.empty() ? "it has no clips at all" : "it has " + names));
}

std::vector<char> choose_instances(const Scene& scene, const std::vector<std::string>& wanted,
                                   std::vector<std::string>& notes) {
  if (wanted.empty()) return std::vector<char>(scene.instances.size(), 1);
  Chooser chooser(scene);
  for (const std::string& name : wanted) chooser.take(name, notes);
  return std::move(chooser).chosen();
}

}  // namespace tvg::cli
