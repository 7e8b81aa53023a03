// The number of threads that a fleet in one process gets. Results do not depend on it.   Threads: any.
#pragma once

#include <cstddef>
#include <optional>

#include "process/status/turn_page.hpp"

namespace skein::cli {

inline constexpr int kMostThreads = static_cast<int>(TurnPage::kSeats);

/// Environment variable by which a study or a hunt tells each of its flights how many threads it may use.
inline constexpr const char* kThreadsVariable = "SKEIN_THREADS";

/// @param asked  --threads; if it is not given, SKEIN_THREADS counts; else the number of cores that this process may
///               use, but not more than UAVs. @throws InputError when the variable is not a valid number of threads.
int threads_of(const std::optional<int>& asked, std::size_t uavs);

/// Threads for each of `flights` simultaneous flights: the usable cores, divided among them; at least 1.
int threads_beside(std::size_t flights);

}  // namespace skein::cli
