// Lets a fleet have enough open files, if the limit (`ulimit -n`) can be raised so far.   Threads: any.
#pragma once

#include <cstdint>
#include <string>

#include "run/fleet_plan.hpp"

namespace skein::cli {

/// How many open files a process of the fleet needs.
struct OpenFilesNeed {
  std::uint64_t least;  ///< with fewer, the fleet cannot start: those of the process with most
  std::uint64_t ample;  ///< with fewer, a program may fail: an estimate, rounded up
};
OpenFilesNeed open_files_need(const FleetPlan& plan);

/// @param limit  open files that a process may have.
/// @returns a warning when `limit` may be too low; empty: it is not.
/// @throws InputError that names the limit and the need when the fleet cannot start.
std::string check_open_files(const FleetPlan& plan, std::uint64_t limit);

/// Raises this process's limit, which the programs inherit, to what the fleet needs, as far as the system permits, and
/// checks it as above. Of a fleet on several hosts (--place), this is about the programs on this host; the others need
/// less. The usual limit of 1024 is there for programs that call select(), which takes no greater descriptors. Of a
/// fleet's programs, only those over Cyclone DDS call it, and they need fewer.
std::string allow_open_files(const FleetPlan& plan);

/// The same for the launcher alone, whose fleet flies in containers: their limits are the engine's.
/// @throws InputError that names the limit and the need when the launcher cannot follow the fleet.
void allow_launcher_open_files(const FleetPlan& plan);

}  // namespace skein::cli
