// A pool of threads for the parallel loops (core/for_each.hpp) of a flight in one process. Results must not depend on
// which thread runs an iteration, or when: each iteration writes only to memory of its own, and the caller combines the
// results in the order of the iterations.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace skein {

class Workers {
 public:
  /// @param threads  number of threads, including the caller's; 1: no further threads.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return static_cast<int>(helpers_.size()) + 1; }
  /// Number of the calling thread: 1, 2, ... for the pool's helpers, 0 for all other threads.
  static int here();

  /// Calls work(0) ... work(count - 1), each once, on any of the threads, and returns when all calls have returned. If
  /// calls throw, run() throws the exception of the one with the lowest index. A call of run() within work() runs its
  /// loop on the calling thread. The helpers' CPU time counts as the caller's (thread_cpu.hpp).
  /// Threads: only the thread that created the pool, and its helpers.
  void run(std::size_t count, const std::function<void(std::size_t)>& work);

 private:
  struct Job {
    const std::function<void(std::size_t)>* work = nullptr;
    std::size_t count = 0;
    std::atomic<std::size_t> next = 0;
    std::mutex mutex = {};
    std::size_t first_failed = 0;
    std::exception_ptr failure = {};
    double helpers_cpu_s = 0.0;
  };

  void help(int number);
  static void take_part(Job& job);

  std::mutex mutex_;
  std::condition_variable changed_, done_;
  Job* job_ = nullptr;                    ///< current job
  std::atomic<std::uint64_t> round_ = 0;  ///< number of the job; helpers poll it for a while before they sleep
  std::size_t wanted_ = 0;                ///< helpers that may yet join the job
  std::atomic<std::size_t> busy_ = 0;     ///< helpers in the job
  bool over_ = false;
  std::vector<std::thread> helpers_;
};

}  // namespace skein
