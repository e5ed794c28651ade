#include "encoder/importers/trial.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <initializer_list>
#include <new>
#include <optional>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__)
#define TVG_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TVG_ADDRESS_SANITIZER 1
#endif
#endif

namespace tvg::cli {

namespace {

constexpr int kOutOfMemory = 3;  // the child's exit status

/// Bytes of address space that this process has.
std::optional<std::uint64_t> address_space() {
#ifndef TVG_ADDRESS_SANITIZER
  std::FILE* file = std::fopen("/proc/self/statm", "re");
  if (file == nullptr) return std::nullopt;
  unsigned long long pages = 0;
  const int read = std::fscanf(file, "%llu", &pages);
  std::fclose(file);
  if (read == 1) return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
#endif
  return std::nullopt;
}

/// A limit of the child; one that the user set lower stays.
template <class Resource>
void limit(Resource resource, std::uint64_t soft, std::uint64_t hard) {
  rlimit present{};
  if (getrlimit(resource, &present) != 0) return;
  rlimit wanted{soft, hard};
  if (present.rlim_max < wanted.rlim_max) wanted.rlim_max = present.rlim_max;
  if (present.rlim_cur < wanted.rlim_cur) wanted.rlim_cur = present.rlim_cur;
  if (wanted.rlim_max < wanted.rlim_cur) wanted.rlim_cur = wanted.rlim_max;
  setrlimit(resource, &wanted);
}

[[noreturn]] void run_child(const std::function<void()>& action, const TrialLimits& limits) {
  // Signals that end the tool end the child too, and no handler of the tool's runs here.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGALRM, SIGXCPU}) std::signal(signal, SIG_DFL);
  // A crash is expected here: it leaves neither a core nor a report.
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_CPU, limits.cpu_seconds, std::uint64_t{limits.cpu_seconds} + 1);
  alarm(limits.wall_seconds);
  if (const auto present = address_space()) {
    limit(RLIMIT_AS, *present + limits.memory_bytes, *present + limits.memory_bytes);
    // Not by an exception, which the action may take for something else and swallow.
    std::set_new_handler([] { _exit(kOutOfMemory); });
  }
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

TrialResult result_of(int status) {
  if (WIFEXITED(status)) {
    const int code = WEXITSTATUS(status);
    return code == 0              ? TrialResult::kFine
           : code == kOutOfMemory ? TrialResult::kTooMuchMemory
                                  : TrialResult::kCrashed;
  }
  switch (WTERMSIG(status)) {
    case SIGXCPU:
    case SIGALRM:
      return TrialResult::kTooLong;
    case SIGKILL:  // by a system that has no memory left
      return TrialResult::kTooMuchMemory;
    default:
      return TrialResult::kCrashed;
  }
}

}  // namespace

TrialResult run_trial(const std::function<void()>& action, const TrialLimits& limits) {
  const pid_t child = fork();
  if (child < 0) return TrialResult::kFine;
  if (child == 0) run_child(action, limits);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return TrialResult::kFine;
  }
  return result_of(status);
}

}  // namespace tvg::cli
