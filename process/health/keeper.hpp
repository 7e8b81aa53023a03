// For programs that no launcher watches over, such as those in containers: the process that was started only keeps
// another one alive that does the work, and starts it again whenever it has been killed, as faults do.
#pragma once

#include <optional>

namespace skein {

/// Before any thread is started. Parts this process in two.
/// @param lives  counts on in the one that is to do the work.
/// @returns nullopt in the one that is to do the work. In the other, which keeps it, not before the work has ended in
///   any way but by SIGKILL: its exit code, or 128 + its signal. SIGTERM, SIGINT and SIGHUP are passed on; after the
///   first of them nothing is started again.
/// @throws std::system_error when there can be no other process.
std::optional<int> keep_alive(int& lives);

}  // namespace skein
