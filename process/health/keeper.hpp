// For programs without a launcher, such as those in containers: the started process, the keeper, forks a worker process
// that runs the program, and starts a new worker whenever SIGKILL has ended it (as a fault `kill` does).
#pragma once

#include <optional>

namespace skein {

/// Forks this process into keeper and worker. Call it before any thread is started.
/// @param lives  number of workers so far; incremented for each worker, in both processes.
/// @returns nullopt in the worker. In the keeper, it returns when a worker has ended and no other will follow: the exit
///   code of that worker, or 128 + its signal. The keeper passes on SIGTERM, SIGINT and SIGHUP; after the first of
///   these, it starts no further worker.
/// @throws std::system_error if no process can be forked.
std::optional<int> keep_alive(int& lives);

}  // namespace skein
