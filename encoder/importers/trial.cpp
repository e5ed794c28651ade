#include "encoder/importers/trial.hpp"

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tvg::cli {

namespace {

[[noreturn]] void run_child(const std::function<void()>& action, unsigned seconds) {
  // A crash is expected here: it leaves neither a core nor a report.
  const rlimit no_core{0, 0};
  const rlimit time{seconds, seconds};
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_CPU, &time);
  if (const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0) {
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
  }
  try {
    action();
  } catch (...) {
    // An exception will come again outside of the trial, where it is told.
  }
  _exit(0);
}

}  // namespace

TrialResult run_trial(const std::function<void()>& action, unsigned seconds) {
  const pid_t child = fork();
  if (child < 0) return TrialResult::kFine;
  if (child == 0) run_child(action, seconds);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return TrialResult::kFine;
  }
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)) {
    return TrialResult::kTooLong;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? TrialResult::kFine : TrialResult::kCrashed;
}

}  // namespace tvg::cli
