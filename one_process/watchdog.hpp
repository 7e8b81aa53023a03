// A program that shares its process and never ends its turn stops all others, on whatever thread it has that. Nothing
// can be done for them but to end the process, and to say whose fault it is.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "one_process/crew.hpp"

namespace skein::one_process {

class Watchdog {
 public:
  /// Watches from a thread of its own. @param patience_s  of wall time for one turn; 0: for ever.
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
