#include "encoder/gop_queue.hpp"

#include "base/errors.hpp"

#include <exception>
#include <system_error>
#include <utility>

namespace tvg {

namespace {

/// A thread must not end by an exception; the only one that encoding knows is want of memory.
Result<EncodedRun> run_guarded(const GopQueue::Work& work) {
  try {
    return work();
  } catch (const std::exception&) {
    return out_of_memory("there is not enough memory: use fewer frames per GOP or fewer threads");
  }
}

}  // namespace

GopQueue::~GopQueue() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
    waiting_.clear();
  }
  work_added_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void GopQueue::start_thread() {
  try {
    workers_.emplace_back([this] { run(); });
  } catch (const std::system_error&) {
    // Those that run already will do, or whoever adds.
  }
}

void GopQueue::add(Work work) {
  if (threads_ > 1 && workers_.size() < threads_) start_thread();
  if (workers_.empty()) {
    Entry entry{{}, run_guarded(work)};
    const std::lock_guard lock(mutex_);
    entries_.push_back(std::move(entry));
    return;
  }
  const std::lock_guard lock(mutex_);
  entries_.push_back({std::move(work), {}});
  waiting_.push_back(&entries_.back());
  work_added_.notify_one();
}

bool GopQueue::full() {
  const std::lock_guard lock(mutex_);
  return full_now();
}

bool GopQueue::full_now() const {
  if (workers_.empty()) return !entries_.empty();
  return waiting_.size() + at_work_ > threads_ || entries_.size() > 2 * std::size_t{threads_};
}

void GopQueue::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    work_added_.wait(lock, [this] { return closing_ || !waiting_.empty(); });
    if (closing_) return;
    Entry& entry = *waiting_.front();
    waiting_.pop_front();
    ++at_work_;
    Work work = std::move(entry.work);
    lock.unlock();
    Result<EncodedRun> done = run_guarded(work);
    work = nullptr;
    lock.lock();
    --at_work_;
    entry.run = std::move(done);
    work_done_.notify_all();
  }
}

}  // namespace tvg
