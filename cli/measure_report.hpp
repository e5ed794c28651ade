#pragma once
#include "cli/gop_statistics.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <tvg/measure.hpp>

namespace tvg::cli {

/// What `tvg measure` tells of a sequence.
struct MeasureReport {
  std::string input;     ///< "hand.obj, hand.pc2"
  std::string criteria;  ///< as typed: "curv+0.5*skel"
  Importance importance;
  std::uint32_t vertices = 0;
  std::uint64_t faces = 0;
  std::uint64_t first_frame = 0;  ///< number of the first frame measured; those of `gops` count from it
  Skeleton skeleton;              ///< of the source; empty where it has none
  std::vector<GopStatistics> gops;
};

/// To standard output: a table of GOPs with their histograms, and one of joints.
void print_report(const MeasureReport& report);
/// The same as JSON, with every figure of every GOP.
void print_report_json(const MeasureReport& report);

}  // namespace tvg::cli
