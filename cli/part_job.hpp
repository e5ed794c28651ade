#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tvg/join.hpp>

// The two ends of work on several machines: a part is encoded, and all parts are put together.
namespace tvg::cli {

struct PartArguments {
  std::string plan;
  std::optional<std::uint32_t> part;  ///< from 1 on; all where absent
  std::string output;                 ///< of the one part; as the plan has it where empty
  unsigned threads = 0;               ///< 0: one per processor
  bool again = false;                 ///< even what is there
  bool json = false;
  bool quiet = false;
};

/// Encodes a part, or one after the other those that are not there and whole. Throws ToolError, whose message
/// names the part.
void run_parts(const PartArguments& arguments);

/// The streams of a plan's parts, in their order, and where their whole goes.
struct PlannedJoin {
  std::vector<std::string> inputs;
  std::string output;
};

/// Throws ToolError: kInvalidInput where parts are not there, all of which it names, or come of another plan.
PlannedJoin planned_join(const std::string& plan_path);

/// A stream that is read once, from a file, an address or standard input (-). Throws ToolError (kIo).
JoinInput open_join_input(const std::string& path);

}  // namespace tvg::cli
