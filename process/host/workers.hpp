// Threads that help the one that has the work: of a flight in one process, which may use more than one core.
// Nothing of a result may depend on who does what, or when: each piece writes to its own place, and whoever shares the
// work adds up in the order of the pieces.
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
  /// @param threads  of which one is the caller's; with 1 there are no others.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return static_cast<int>(helpers_.size()) + 1; }
  /// Which of the threads this is: 0 is the one that made them, or none of them.
  static int here();

  /// Does work(0) ... work(count - 1), each once, on any of the threads, and returns when all are done. If some throw,
  /// the exception of the first of them leaves, when all that have begun are over. Within a piece of work: one after
  /// another, on that thread. The CPU time of the helpers counts as the caller's (thread_cpu.hpp).
  /// Threads: the one that made this, and its helpers.
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
  Job* job_ = nullptr;                    ///< under way
  std::atomic<std::uint64_t> round_ = 0;  ///< which job; helpers look at it before they sleep
  std::size_t wanted_ = 0;                ///< helpers that may yet join the job
  std::atomic<std::size_t> busy_ = 0;     ///< helpers in the job
  bool over_ = false;
  std::vector<std::thread> helpers_;
};

}  // namespace skein
