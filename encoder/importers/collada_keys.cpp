#include "encoder/importers/collada_keys.hpp"

#include "encoder/importers/input_file.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::array<std::string_view, 4> kCurves = {"BEZIER", "HERMITE", "CARDINAL", "BSPLINE"};

/// Adds a list of names, unless it holds others than those of interpolations: joints of a skin, perhaps.
void take_list(std::string_view list, ColladaKeys& keys) {
  ColladaKeys taken = keys;
  std::size_t count = 0;
  for (std::size_t begin = list.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(list.find_first_of(kBlanks, begin), list.size());
    const std::string_view name = list.substr(begin, end - begin);
    const bool curve = std::find(kCurves.begin(), kCurves.end(), name) != kCurves.end();
    if (name != "LINEAR" && name != "STEP" && !curve) return;
    taken.has_lines = taken.has_lines || name == "LINEAR";
    taken.has_steps = taken.has_steps || name == "STEP";
    taken.has_curves = taken.has_curves || curve;
    ++count;
    begin = list.find_first_not_of(kBlanks, end);
  }
  if (count == 0) return;
  taken.counts.push_back(count);
  keys = std::move(taken);
}

bool has_keys(const Track& track, std::size_t count) {
  return track.times.size() <= 1 || track.times.size() == count;
}

/// Whether all lists have as many keys as all tracks: assimp has then put in none of its own.
bool is_untouched(const Clip& clip, const ColladaKeys& keys) {
  const std::size_t count = keys.counts.front();
  return std::all_of(keys.counts.begin(), keys.counts.end(),
                     [&](std::size_t other) { return other == count; }) &&
         clip.morphs.empty() &&
         std::all_of(clip.nodes.begin(), clip.nodes.end(), [&](const NodeChannel& channel) {
           return has_keys(channel.positions, count) && has_keys(channel.rotations, count) &&
                  has_keys(channel.scales, count);
         });
}

}  // namespace

ColladaKeys find_collada_keys(std::string_view text) {
  constexpr std::string_view kOpen = "<Name_array";
  ColladaKeys keys;
  for (std::size_t at = text.find(kOpen); at != std::string_view::npos; at = text.find(kOpen, at)) {
    const std::size_t begin = text.find('>', at);
    if (begin == std::string_view::npos) break;
    const std::size_t end = std::min(text.find('<', begin), text.size());
    take_list(text.substr(begin + 1, end - begin - 1), keys);
    at = end;
  }
  return keys;
}

void restore_collada_keys(const std::string& path, Clip& clip, std::vector<std::string>& notes) {
  std::string text;
  read_file(path, text);
  const ColladaKeys keys = find_collada_keys(text);
  if (!keys.has_steps && !keys.has_curves) return;
  if (keys.has_steps && !keys.has_curves && !keys.has_lines && is_untouched(clip, keys)) {
    for (NodeChannel& channel : clip.nodes) {
      for (Track* track : {&channel.positions, &channel.rotations, &channel.scales}) {
        track->interpolation = Interpolation::kStep;
      }
    }
    return;
  }
  notes.push_back(fmt::format("{}: {} keys are read as linear ones; export the clip sampled to keep them",
                              path,
                              keys.has_steps && keys.has_curves ? "stepped and curved"
                              : keys.has_steps                  ? "stepped"
                                                                : "curved"));
}

}  // namespace tvg::cli
