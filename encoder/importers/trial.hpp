#pragma once
#include <cstdint>
#include <functional>

namespace tvg::cli {

/// How a trial ended.
enum class TrialResult { kFine, kCrashed, kTooLong, kTooMuchMemory };

/// What a trial may cost.
struct TrialLimits {
  unsigned cpu_seconds = 120;
  unsigned wall_seconds = 300;  ///< for a file system that does not answer, and for waiting in general
  /// Address space beyond what the process has already. Not kept where the system does not say how much that
  /// is, nor under a sanitizer of addresses, which takes terabytes of it.
  std::uint64_t memory_bytes = std::uint64_t{1} << 32;
};

/// Runs `action` in a child process, whose output goes nowhere and which ends at its limits, to learn whether
/// it comes back: for libraries that crash, hang or take all memory on damaged files. What the action changes
/// in memory is lost. Where the system gives no process, the result is kFine.
TrialResult run_trial(const std::function<void()>& action, const TrialLimits& limits);

}  // namespace tvg::cli
