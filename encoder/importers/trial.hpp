#pragma once
#include <functional>
#include <string>

namespace tvg::cli {

/// How a trial ended.
enum class TrialResult { kFine, kCrashed, kTooLong };

/// Runs `action` in a child process, whose output goes nowhere and which has `seconds` of processor time, to
/// learn whether it comes back: for libraries that crash or hang on damaged files. What the action changes in
/// memory is lost. Where the system gives no process, the result is kFine.
TrialResult run_trial(const std::function<void()>& action, unsigned seconds);

}  // namespace tvg::cli
