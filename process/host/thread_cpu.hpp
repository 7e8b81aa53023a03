// What a program has cost so far.
#pragma once

#include <ctime>

namespace skein {

namespace thread_cpu_detail {

/// What a thread that does the work of several programs has spent on the others.
inline thread_local double of_others_s = 0.0;

inline double total_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace thread_cpu_detail

/// CPU time of the calling thread [s], user and kernel. On a thread that several programs share, two of them tell the
/// time between them within one turn; those of a program that begins its share with each turn, its own over all turns.
inline double thread_cpu_s() { return thread_cpu_detail::total_s() - thread_cpu_detail::of_others_s; }

/// From here on the calling thread works for a program that has cost it `so_far_s` before.
inline void begin_thread_cpu_share(double so_far_s) {
  thread_cpu_detail::of_others_s = thread_cpu_detail::total_s() - so_far_s;
}

/// Other threads have worked so long for the calling thread's program.
inline void add_thread_cpu(double seconds) { thread_cpu_detail::of_others_s -= seconds; }

}  // namespace skein
