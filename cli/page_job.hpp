#pragma once
#include "cli/ladder_job.hpp"

#include <string>
#include <vector>

namespace tvg::cli {

/// Values of the options of `tvg page` as typed.
struct PageArguments : LadderArguments {
  std::string output;
  std::string title;
  std::string player;
  bool ladder = false;
  bool no_poster = false;
  std::vector<std::string> encoding;  ///< names of the options given that say how to encode
};

/// Makes the page. Throws ToolError.
void run_page(const PageArguments& arguments);

}  // namespace tvg::cli
