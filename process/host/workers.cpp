#include "process/host/workers.hpp"

#include <algorithm>

#include "process/health/crash_notes.hpp"
#include "process/host/thread_cpu.hpp"

namespace skein {
namespace {

/// True within run() and in helpers: a nested run() executes its loop on the calling thread.
thread_local bool at_work = false;
thread_local int number_here = 0;  ///< see here()

/// Number of polls before a thread sleeps. The jobs of a step follow each other within tens of microseconds, about the
/// time that waking a thread takes. Each poll yields, so that other threads run if there are fewer cores than threads.
constexpr int kLooks = 200;

}  // namespace

Workers::Workers(int threads) {
  for (int i = 1; i < threads; ++i) helpers_.emplace_back([this, i] { help(i); });
}

Workers::~Workers() {
  {
    const std::scoped_lock lock(mutex_);
    over_ = true;
    ++round_;
  }
  changed_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void Workers::run(std::size_t count, const std::function<void(std::size_t)>& work) {
  if (helpers_.empty() || count < 2 || at_work) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  Job job{.work = &work, .count = count};
  const std::size_t helpers = std::min(helpers_.size(), count - 1);
  {
    const std::scoped_lock lock(mutex_);
    job_ = &job;
    wanted_ = helpers;
    ++round_;
  }
  helpers == 1 ? changed_.notify_one() : changed_.notify_all();
  at_work = true;
  take_part(job);
  at_work = false;
  for (int look = 0; look < kLooks && busy_ > 0; ++look) std::this_thread::yield();
  {
    std::unique_lock lock(mutex_);
    wanted_ = 0;  // helpers that have not woken yet are too late
    done_.wait(lock, [this] { return busy_ == 0; });
    job_ = nullptr;
  }
  add_thread_cpu(job.helpers_cpu_s);
  if (job.failure) std::rethrow_exception(job.failure);
}

void Workers::take_part(Job& job) {
  for (std::size_t i = job.next++; i < job.count; i = job.next++) {
    try {
      (*job.work)(i);
    } catch (...) {
      const std::scoped_lock lock(job.mutex);
      if (!job.failure || i < job.first_failed) {
        job.failure = std::current_exception();
        job.first_failed = i;
      }
    }
  }
}

int Workers::here() { return number_here; }

void Workers::help(int number) {
  number_here = number;
  const CrashStack stack;
  at_work = true;
  for (std::uint64_t seen = 0;;) {
    for (int look = 0; look < kLooks && round_ == seen; ++look) std::this_thread::yield();
    Job* job = nullptr;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return round_ != seen; });
      seen = round_;
      if (over_) return;
      if (wanted_ == 0) continue;
      --wanted_;
      ++busy_;
      job = job_;
    }
    const double before_s = thread_cpu_s();
    take_part(*job);
    const double spent_s = thread_cpu_s() - before_s;
    {
      const std::scoped_lock lock(mutex_);
      job->helpers_cpu_s += spent_s;
      --busy_;
    }
    done_.notify_one();
  }
}

}  // namespace skein
