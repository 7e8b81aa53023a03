// Lets a program wait for a debugger. Linux.
#pragma once

#include <functional>

namespace skein {

/// Whether a debugger is attached to this process.
bool is_debugged();

/// Waits until a debugger is attached (or was attached and has left again), SIGCONT arrives, or `stop` returns true.
/// From now on any process of this user may attach, even if the kernel's security module Yama restricts this. Call it
/// from one thread only.
void wait_for_debugger(const std::function<bool()>& stop);

}  // namespace skein
