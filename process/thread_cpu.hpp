// What a thread has cost so far.
#pragma once

#include <ctime>

namespace skein {

/// CPU time of the calling thread [s], user and kernel.
inline double thread_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace skein
