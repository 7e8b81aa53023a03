// How many threads a fleet in one process gets. Results do not depend on it.   Threads: any.
#pragma once

#include <cstddef>
#include <optional>

#include "process/status/turn_page.hpp"

namespace skein::cli {

inline constexpr int kMostThreads = static_cast<int>(TurnPage::kSeats);

/// Tells the flights that a study or a hunt starts how many threads each may have.
inline constexpr const char* kThreadsVariable = "SKEIN_THREADS";

/// @param asked  --threads; else SKEIN_THREADS counts, else the cores that this process may use: more threads than UAVs
///               have nothing to do. @throws InputError for a variable that is no number of threads.
int threads_of(const std::optional<int>& asked, std::size_t uavs);

/// For each of so many flights that are in the air at once: the cores, dealt out. @param flights  at least 1
int threads_beside(std::size_t flights);

}  // namespace skein::cli
