#include "tool/atomic_file.hpp"

#include "tool/overwriting.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace tvg::cli {

namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 18;

/// A temporary file's name where a signal handler can read it: no allocation, no lock.
struct TemporaryName {
  std::atomic<bool> taken{false};
  std::atomic<bool> valid{false};
  std::array<char, 4096> path{};
};
constexpr std::array kEndingSignals = {SIGINT, SIGTERM, SIGHUP};

/// Files that are made and not registered yet, in all threads; and whether no more may be made.
std::atomic<int> unregistered{0};
std::atomic<bool> ending{false};
static_assert(std::atomic<int>::is_always_lock_free);

/// While it lives, no signal ends the process between the making of a file and its registration: this thread
/// hears of none, and the handler in another thread waits. Nothing is made once the handler runs.
class MakingFile {
 public:
  MakingFile() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : kEndingSignals) sigaddset(&signals, signal);
    pthread_sigmask(SIG_BLOCK, &signals, &before_);
    ++unregistered;
    if (!ending) return;
    --unregistered;
    for (;;) pause();
  }
  ~MakingFile() {
    --unregistered;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  MakingFile(const MakingFile&) = delete;
  MakingFile& operator=(const MakingFile&) = delete;

 private:
  sigset_t before_{};
};

constexpr std::size_t kMostTemporaryNames = 16;
std::array<TemporaryName, kMostTemporaryNames> temporary_names;
static_assert(std::atomic<bool>::is_always_lock_free);

/// Files beyond the table's size are not removed by a signal.
void remember_temporary(const std::string& path) {
  for (TemporaryName& name : temporary_names) {
    if (path.size() >= name.path.size() || name.taken.exchange(true)) continue;
    std::memcpy(name.path.data(), path.c_str(), path.size() + 1);
    name.valid = true;
    return;
  }
}

void forget_temporary(const std::string& path) {
  for (TemporaryName& name : temporary_names) {
    if (!name.valid || path != name.path.data()) continue;
    name.valid = false;
    name.taken = false;
  }
}

extern "C" void remove_temporaries_and_end(int signal) {
  constexpr timespec kMoment{0, 1000000};
  ending = true;
  for (int moments = 0; unregistered > 0 && moments < 1000; ++moments) nanosleep(&kMoment, nullptr);
  for (const TemporaryName& name : temporary_names) {
    if (name.valid) unlink(name.path.data());
  }
  raise(signal);  // its default action, restored by SA_RESETHAND, tells the caller why the process ended
}

}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {
  buffer_.reserve(kBufferSize);
  if (path_ == "-") {
    descriptor_ = STDOUT_FILENO;
    if (isatty(descriptor_) != 0) {
      throw ToolError(ExitStatus::kUsage, "standard output is a terminal: redirect it to a file or a pipe");
    }
    return;
  }
  struct stat status {};
  const bool exists = stat(path_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail("it is a folder", 0);
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("", errno);
    return;
  }
  if (exists && access(path_.c_str(), W_OK) != 0) fail("", errno);
  if (exists) confirm_overwriting(path_);
  std::error_code no_target;
  target_ = exists ? std::filesystem::canonical(path_, no_target).string() : path_;
  if (no_target) target_ = path_;
  open_temporary(target_);
  if (exists) static_cast<void>(fchmod(descriptor_, status.st_mode & 07777));
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0 && descriptor_ != STDOUT_FILENO) close(descriptor_);
  if (temporary_.empty()) return;
  unlink(temporary_.c_str());
  forget_temporary(temporary_);
}

void AtomicFile::open_temporary(const std::string& target) {
  const std::string stem = target + ".tmp" + std::to_string(getpid());
  constexpr int kAttempts = 100;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    std::string name = stem;
    if (attempt > 0) name.append(1, '-').append(std::to_string(attempt));
    const MakingFile making;
    descriptor_ = open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) {
      temporary_ = std::move(name);
      remember_temporary(temporary_);
      return;
    }
    if (errno != EEXIST) break;
  }
  fail("", errno);
}

void AtomicFile::fail(const std::string& what, int error_number) const {
  const std::string name = path_ == "-" ? "standard output" : path_;
  const std::string reason = error_number == 0 ? what : what + std::generic_category().message(error_number);
  throw ToolError(ExitStatus::kIo, "cannot write " + name + ": " + reason);
}

void AtomicFile::write(const void* data, std::size_t size) {
  const char* bytes = static_cast<const char*>(data);
  if (buffer_.size() + size > kBufferSize) flush();
  if (size >= kBufferSize) {
    write_at(flushed_, bytes, size);
    flushed_ += size;
  } else {
    buffer_.insert(buffer_.end(), bytes, bytes + size);
  }
}

void AtomicFile::flush() {
  write_at(flushed_, buffer_.data(), buffer_.size());
  flushed_ += buffer_.size();
  buffer_.clear();
}

void AtomicFile::write_at(std::uint64_t offset, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = seekable() ? pwrite(descriptor_, data, size, static_cast<off_t>(offset))
                                       : ::write(descriptor_, data, size);
    if (written < 0) {
      if (errno == EINTR) continue;
      fail("", errno);
    }
    data += written;
    size -= static_cast<std::size_t>(written);
    offset += static_cast<std::uint64_t>(written);
  }
}

void AtomicFile::overwrite(std::uint64_t offset, const void* data, std::size_t size) {
  flush();
  write_at(offset, static_cast<const char*>(data), size);
}

void AtomicFile::move_tail(std::uint64_t from, std::uint64_t to) {
  flush();
  std::array<char, std::size_t{1} << 16> block;
  const std::uint64_t length = flushed_ - from;
  // Blocks go last to first where the tail moves towards the end, so that none is overwritten before it is
  // read.
  for (std::uint64_t done = 0; done < length;) {
    const std::uint64_t size = std::min<std::uint64_t>(block.size(), length - done);
    const std::uint64_t start = to > from ? length - done - size : done;
    for (std::uint64_t filled = 0; filled < size;) {
      const ssize_t got =
          pread(descriptor_, block.data() + filled, size - filled, static_cast<off_t>(from + start + filled));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) fail("it cannot be read back: ", got < 0 ? errno : EIO);
      filled += static_cast<std::uint64_t>(got);
    }
    write_at(to + start, block.data(), size);
    done += size;
  }
  flushed_ = to + length;
  if (ftruncate(descriptor_, static_cast<off_t>(flushed_)) != 0) fail("", errno);
}

void AtomicFile::finish() {
  flush();
  if (descriptor_ == STDOUT_FILENO) return;
  const int closed = close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail("", errno);
  if (temporary_.empty()) return;
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail("", errno);
  forget_temporary(temporary_);
  temporary_.clear();
}

void AtomicFile::finish_as(const std::string& path) {
  path_ = path;
  target_ = path;
  finish();
}

void remove_temporary_files_on_signals() {
  struct sigaction action {};
  action.sa_handler = remove_temporaries_and_end;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : kEndingSignals) {
    struct sigaction current {};
    if (sigaction(signal, nullptr, &current) == 0 && current.sa_handler == SIG_IGN) continue;  // nohup
    sigaction(signal, &action, nullptr);
  }
}

}  // namespace tvg::cli
