#pragma once
#include "cli/bench_job.hpp"

#include <string>
#include <vector>

namespace tvg::cli {

/// A table for people: the animation and a line for each row.
std::string bench_table(const BenchedAnimation& animation);

/// What the table's columns mean, in a line or two.
std::string bench_legend(int runs);

/// Comma-separated values: the names of the columns, then a line for every row. Lengths are in the units of
/// the mesh; what does not apply is empty.
std::string bench_csv_header();
std::string bench_csv(const BenchedAnimation& animation);

/// Everything, as JSON.
std::string bench_json(const std::vector<BenchedAnimation>& animations);

/// An SVG with two plots for each animation: KG error and STED over bits per coordinate.
std::string bench_plots(const std::vector<BenchedAnimation>& animations);

}  // namespace tvg::cli
