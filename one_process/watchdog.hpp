// Finds a program that does not end its turn. Such a program blocks all others of the process, no matter which thread
// runs its turn. The only remedy is to end the process, and to report which program is the cause.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "one_process/crew.hpp"

namespace skein::one_process {

class Watchdog {
 public:
  /// Starts the watching thread. @param crew  must outlive this. @param patience_s  wall time for a turn; 0: no limit.
  Watchdog(const Crew& crew, double patience_s);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

 private:
  void watch(double patience_s);

  const Crew& crew_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false;
  std::thread thread_;
};

}  // namespace skein::one_process
