#include "cli/bench_inputs.hpp"

#include "encoder/importers/sequence_files.hpp"
#include "tool/mesh_format.hpp"
#include "tool/overwriting.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>

namespace tvg::cli {

namespace {

namespace fs = std::filesystem;

bool is_cache(const std::string& path) {
  return path == "-" || is_cache_file(path);
}

bool awaits_cache(const BenchInput& group) {
  return group.files.size() == 1 && mesh_format(group.files[0]).has_value();
}

/// The mesh that the cache inputs[place] goes with; null where there is none.
BenchInput* mesh_of(std::vector<BenchInput>& groups, const std::vector<std::string>& inputs,
                    std::size_t place) {
  const auto free_mesh = [&groups](const std::string& path) -> BenchInput* {
    const auto found = std::find_if(groups.begin(), groups.end(), [&path](const BenchInput& group) {
      return awaits_cache(group) && group.files[0] == path;
    });
    return found == groups.end() ? nullptr : &*found;
  };
  const fs::path stem = fs::path(inputs[place]).replace_extension();
  for (BenchInput& group : groups) {
    if (awaits_cache(group) && fs::path(group.files[0]).replace_extension() == stem) return &group;
  }
  BenchInput* found = place > 0 ? free_mesh(inputs[place - 1]) : nullptr;
  if (found == nullptr && place + 1 < inputs.size()) found = free_mesh(inputs[place + 1]);
  return found;
}

/// Frame files that a shell has listed would be an animation of one frame each.
void refuse_listed_frames(const std::vector<BenchInput>& groups) {
  std::map<std::string, std::string> sequences;  // by what is around: the first file
  for (const BenchInput& group : groups) {
    if (!awaits_cache(group) || !caches_beside(group.files[0]).empty()) continue;
    const std::string around = sequence_around(group.files[0]);
    if (around.empty()) continue;
    const auto [first, is_new] = sequences.emplace(around, group.files[0]);
    if (is_new) continue;
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("{} and {} are frames of one sequence, and each input is an animation here: "
                                "name it by its folder or its pattern, {}",
                                first->second, group.files[0], around));
  }
}

void name_groups(std::vector<BenchInput>& groups) {
  std::map<std::string, int> count;
  for (BenchInput& group : groups) {
    const std::string& first = group.files[0] == "-" ? group.files.back() : group.files[0];
    group.name = first == "-" ? "-" : fs::path(default_output(first, "")).filename().string();
    ++count[group.name];
  }
  for (BenchInput& group : groups) {
    if (count[group.name] > 1) group.name = group.files[0];
  }
}

}  // namespace

std::vector<BenchInput> group_inputs(const std::vector<std::string>& inputs) {
  std::vector<BenchInput> groups;
  for (const std::string& input : inputs) {
    if (!is_cache(input)) groups.push_back({{}, {input}});
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!is_cache(inputs[i])) continue;
    if (BenchInput* mesh = mesh_of(groups, inputs, i)) {
      mesh->files.push_back(inputs[i]);
    } else {
      groups.push_back({{}, {inputs[i]}});  // opening it tells that it has no faces
    }
  }
  refuse_listed_frames(groups);
  name_groups(groups);
  return groups;
}

}  // namespace tvg::cli
