// A minder is a process between the launcher and a program that may leave children behind, such as a user's command or
// agent program. If a process below the minder loses its parent, the kernel makes it a child of the minder (prctl(2),
// PR_SET_CHILD_SUBREAPER), in whatever session or process group it runs. So the minder can kill all these processes
// when the program has ended or the launcher has died.
// Threads: one, because a minder is a fork of the launcher, which has one thread.
#pragma once

#include <sys/types.h>

namespace skein::cli {

/// Turns this process, a fork of the launcher, into a minder. Call it before this process forks the program.
/// @returns false if the launcher is already dead.
bool become_minder(pid_t launcher);

/// Waits until the program or the launcher has ended. Then kills all remaining descendants of this process, and ends as
/// the program did, with the same exit code or by the same signal; with exit code 137 if the launcher ended first. If a
/// signal stops the program, this process stops, too. To continue them, SIGCONT must go to both; SIGKILL to the program
/// must be followed by SIGCONT to this process.
[[noreturn]] void mind(pid_t program, pid_t launcher);

}  // namespace skein::cli
