// Lets a fleet have enough open files, if the limit (`ulimit -n`) can be raised so far.   Threads: any.
#pragma once

#include <cstdint>
#include <string>

#include "process/host/open_files.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {

/// Open files of a process that starts, watches and ends so many programs, and holds the locks on so many domains: the
/// launcher, or its counterpart on another host (--place).
constexpr std::uint64_t open_files_of_watcher(std::uint64_t programs, std::uint64_t domains) {
  return 10 + 4 * programs + domains;  // of each program two pipes, the log and the pidfd
}

/// The number of open files that a process of the fleet needs at most.
OpenFilesNeed open_files_need(const FleetPlan& plan);

/// Raises this process's limit, which the programs inherit, to what the fleet needs, as far as the system permits. Of a
/// fleet on several hosts (--place), this is about the programs on this host; the others need less, raise their limits
/// themselves, and say so if they cannot. The usual limit of 1024 is there for programs that call select(), which takes
/// no greater descriptors. Of a fleet's programs, only those over Cyclone DDS call it, and they need fewer.
/// @returns a warning when the limit may still be too low; empty: it is not.
/// @throws InputError that names the limit and the need when the fleet cannot start.
std::string allow_open_files(const FleetPlan& plan);

/// The same for the launcher alone, whose fleet flies in containers: their limits are the engine's.
/// @throws InputError that names the limit and the need when the launcher cannot follow the fleet.
void allow_launcher_open_files(const FleetPlan& plan);

}  // namespace skein::cli
