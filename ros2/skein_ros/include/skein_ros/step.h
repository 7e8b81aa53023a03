// Functions that libskein_step.so offers to the libraries for planners, in C++ and in Python. They exist only if
// libskein_step.so is loaded, so look for them with dlsym(). Threads: the node's.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#pragma GCC visibility push(default)
#ifdef __cplusplus
extern "C" {
#endif

/// True if this process is a program of a fleet, and steps with it.
bool skein_ros_is_member(void);

/// `plan(context)` is called at the end of each step, when the node has nothing else left to do in it.
void skein_ros_before_answer(void (*plan)(void* context), void* context);

/// Sleeps until this simulated time [ns]; steps are answered meanwhile. False: the run is over.
bool skein_ros_sleep_until(int64_t until_ns);

/// Names a mistake and ends the process with exit code 3.
void skein_ros_fail(const char* why);

#ifdef __cplusplus
}
#endif
#pragma GCC visibility pop
