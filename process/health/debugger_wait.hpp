// A program that stands still until somebody looks into it. Linux.
#pragma once

#include <functional>

namespace skein {

/// Whether a debugger is attached to this process.
bool is_debugged();

/// Returns when a debugger is attached to this process, or has been and has left again, or SIGCONT has come, or `stop`
/// is true. Any process of this user may attach from here on, whatever the kernel's rules for others (Yama). Call it
/// from one thread.
void wait_for_debugger(const std::function<bool()>& stop);

}  // namespace skein
