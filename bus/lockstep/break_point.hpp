// A stop for the debugger of a program, at a simulated time (--break-at).   Threads: that of the program's node.
#pragma once

#include "core/types.hpp"

namespace skein::bus {

/// Before the program is at work. @param seconds  simulated
void set_break_at(double seconds);

/// To be called before each step is thought about. In the last one before that time it raises SIGTRAP, once, if this
/// process is debugged: without a debugger it would die of it. @param tick  of the step
void break_if_due(Tick tick);

}  // namespace skein::bus
