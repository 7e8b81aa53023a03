// Stops a program in its debugger at a simulated time (--break-at).   Threads: only the thread of the program's node.
#pragma once

#include "core/types.hpp"

namespace skein::bus {

/// Call it before the program starts to work. @param seconds  simulated time
void set_break_at(double seconds);

/// Call it before the program computes a step. In the last step before the set time it raises SIGTRAP, once, and only
/// if a debugger is attached, because otherwise the signal would kill the process. @param tick  of the step
void break_if_due(Tick tick);

}  // namespace skein::bus
