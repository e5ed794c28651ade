#pragma once
#include "cli/page_job.hpp"
#include "tool/atomic_folder.hpp"

#include <string>

namespace tvg::cli {

/// What a page plays.
struct PageStream {
  std::string url;   ///< from the page
  std::string path;  ///< where the stream lies, or the best of a ladder, until the page is finished
};

/// Whether the input is a ladder that `tvg ladder` made.
bool is_ladder(const PageArguments& arguments);

/// Puts what the input is into the folder of the page: a copy of a .tvg or of a ladder, else the streams that
/// encoding makes of it. What lies there already stays. Throws ToolError: kUsage for options that the input
/// does not take, kInvalidInput, kIo.
PageStream put_streams(const PageArguments& arguments, AtomicFolder& folder);

/// The stream of the input, in a file: the .tvg that it is, or what encoding it writes to `scratch`.
std::string stream_of(const PageArguments& arguments, AtomicFile& scratch);

}  // namespace tvg::cli
