// A minder stands between the launcher and a program that may leave children behind: a user's command, somebody else's
// agent. Whoever loses its parent below it becomes its child (prctl(2), PR_SET_CHILD_SUBREAPER), in whatever session or
// process group, so it can end them all: when the program has ended, and when the launcher has been killed.
#pragma once

#include <sys/types.h>

namespace skein::cli {

/// Makes this process, forked from the launcher, a minder. Call it before the program is started from here.
/// @returns false when the launcher is dead already.
bool become_minder(pid_t launcher);

/// Waits for the program and for the launcher, whichever ends first, then ends all processes that are left below this
/// one, and itself in the program's way: with its exit code or its signal. It stops when the program does.
[[noreturn]] void mind(pid_t program, pid_t launcher);

}  // namespace skein::cli
