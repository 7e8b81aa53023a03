// CPU time that a program has used, also if it shares its thread with other programs.   Threads: any; values are per
// thread.
#pragma once

#include <ctime>

namespace skein {

namespace thread_cpu_detail {

/// Part of the calling thread's CPU time that belongs to other programs [s]. add_thread_cpu() can make it negative.
inline thread_local double of_others_s = 0.0;

inline double total_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace thread_cpu_detail

/// CPU time of the calling thread [s], user and kernel. If several programs share the thread, differences of two
/// results are meaningful within one turn; across turns only for programs that call begin_thread_cpu_share() in each
/// turn.
inline double thread_cpu_s() { return thread_cpu_detail::total_s() - thread_cpu_detail::of_others_s; }

/// From now on the calling thread works for a program whose CPU time so far is `so_far_s`.
inline void begin_thread_cpu_share(double so_far_s) {
  thread_cpu_detail::of_others_s = thread_cpu_detail::total_s() - so_far_s;
}

/// Adds CPU time that other threads spent on the calling thread's program.
inline void add_thread_cpu(double seconds) { thread_cpu_detail::of_others_s -= seconds; }

}  // namespace skein
