// Whether the limit of open files (`ulimit -n`) allows a fleet.   Threads: any.
#pragma once

#include <cstdint>
#include <string>

#include "run/fleet_plan.hpp"

namespace skein::cli {

/// How many open files a process of the fleet needs.
struct OpenFilesNeed {
  std::uint64_t least;  ///< with fewer, the fleet cannot start: the launcher's own, or those of the one process
  std::uint64_t ample;  ///< with fewer, a program may fail: an estimate, rounded up
};
OpenFilesNeed open_files_need(const FleetPlan& plan);

/// @param limit  open files that a process may have.
/// @returns a warning when `limit` may be too low; empty: it is not.
/// @throws InputError that names the limit and the need when the fleet cannot start.
std::string check_open_files(const FleetPlan& plan, std::uint64_t limit);

/// The same with this process's limit, which the programs inherit. A fleet on several hosts (--place) is not checked.
std::string check_open_files(const FleetPlan& plan);

}  // namespace skein::cli
