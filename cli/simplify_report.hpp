#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include <tvg/metrics.hpp>
#include <tvg/simplify.hpp>

namespace tvg::cli {

/// What became of a frame that decided what is removed.
struct SimplifiedFrame {
  std::uint64_t frame = 0;  ///< as the input numbers it
  std::uint32_t vertices = 0, faces = 0;
  std::uint32_t refused = 0;
  double quadric_error = 0;  ///< SimplifyLevel::quadric_error of the last level
};

/// What `tvg simplify` tells of a sequence.
struct SimplifyReport {
  std::string input;     ///< "hand.obj, hand.pc2"
  std::string priority;  ///< as typed: "curv+0.5*skel"
  std::uint32_t vertices = 0, wanted_vertices = 0;
  std::uint64_t faces = 0;
  std::uint64_t frames = 0;       ///< of the input
  std::uint64_t first_frame = 0;  ///< as the input numbers it; those of `distance` count from it
  bool per_keyframe = false;      ///< every frame has a hierarchy of its own; `levels` is then empty
  std::uint64_t remeshed_vertices = 0, remeshed_faces = 0;  ///< 0 where nothing was remeshed
  std::vector<SimplifyLevel> levels;
  std::vector<SimplifiedFrame> results;   ///< at least one
  std::optional<SurfaceReport> distance;  ///< from the original
};

/// The levels and last figures of a simplification in a report, frames by the numbers given.
void add_hierarchy(SimplifyReport& report, const Simplification& made,
                   const std::vector<std::uint64_t>& frames);

/// A few lines for people, to standard error, for the result itself may go to standard output.
void print_simplify_report(const SimplifyReport& report);
nlohmann::json json_of(const SimplifyReport& report);

/// Whether report files have the suffix of `path`: .csv, .json or .svg.
bool is_report_file(const std::string& path);

/// Writes levels, frames and distances: a table (.csv: a row for every level and frame), everything (.json),
/// or plots of the quadric error over frames and levels (.svg). Throws ToolError (kIo).
void write_simplify_report(const std::string& path, const SimplifyReport& report);

}  // namespace tvg::cli
